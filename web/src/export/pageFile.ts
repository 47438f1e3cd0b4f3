/** Puts an animated SVG, and sound if there is any, into one web page that needs no other file: the command line's template. */
import template from '../../../backend/vectortalker/animate/page.html?raw';
import { type Cue, webVtt } from '../speech/captions';

export type PageSound = {
  readonly data: Blob;
  readonly mediaType: string;
  readonly looped: boolean;
  readonly captions: readonly Cue[];
};

/** The text of the page round an animated `svg`, which must not repeat by itself where there is sound. */
export async function pageFile(svg: string, title: string, sound: PageSound | null): Promise<string> {
  return pageText(
    svg,
    title,
    sound && playerOf(await dataUri(sound.data, sound.mediaType), sound.looped, await captionsUri(sound.captions)),
  );
}

/** Fills in the template; `player` is an audio element, with its captions if there are any. */
export function pageText(svg: string, title: string, player: string | null): string {
  const parts: Readonly<Record<string, string>> = { $title: escaped(title), $svg: svg, $player: player ?? '' };
  return template.replace(/\$(title|svg|player)/g, (name) => parts[name]);
}

export function playerOf(source: string, looped: boolean, captionsSource: string | null): string {
  const track = captionsSource === null ? '' : `<track kind="captions" label="Captions" src="${captionsSource}" default>`;
  return `<audio controls${looped ? ' loop' : ''} src="${source}">${track}</audio>`;
}

async function captionsUri(captions: readonly Cue[]): Promise<string | null> {
  return captions.length > 0 ? dataUri(new Blob([webVtt(captions)]), 'text/vtt') : null;
}

function dataUri(data: Blob, mediaType: string): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(String(reader.result));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(new Blob([data], { type: mediaType }));
  });
}

const ENTITIES: Readonly<Record<string, string>> = { '&': '&amp;', '<': '&lt;', '>': '&gt;' };

const escaped = (text: string) => text.replace(/[&<>]/g, (character) => ENTITIES[character]);
