//! Border between the browser and `geometry`: flat arrays in, flat arrays and one string buffer out.
