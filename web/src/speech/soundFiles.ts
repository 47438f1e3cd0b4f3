/** What counts as a sound file, by name and type; the decoders look at the content. */

/** `accept` of file dialogs. */
export const SOUNDS = 'audio/*,.wav,.mp3,.ogg,.oga,.opus,.flac,.m4a,.aac,.webm';

export function isSound({ name, type }: Pick<File, 'name' | 'type'>): boolean {
  return type.startsWith('audio/') || /\.(wav|mp3|og[ga]|opus|flac|m4a|aac|webm)$/i.test(name);
}
