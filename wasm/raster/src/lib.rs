//! Turns control points and fills into pixels, and pixel errors into exact gradients.
