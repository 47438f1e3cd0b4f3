/** Puts an animated SVG, and sound if there is any, into one web page that needs no other file: the command line's template. */
import template from '../../../backend/vectortalker/animate/page.html?raw';

export type PageSound = { readonly data: Blob; readonly mediaType: string; readonly looped: boolean };

/** The text of the page round an animated `svg`, which must not repeat by itself where there is sound. */
export async function pageFile(svg: string, title: string, sound: PageSound | null): Promise<string> {
  return pageText(svg, title, sound && playerOf(await dataUri(sound), sound.looped));
}

/** Fills in the template; `player` is an audio element. */
export function pageText(svg: string, title: string, player: string | null): string {
  const parts: Readonly<Record<string, string>> = { $title: escaped(title), $svg: svg, $player: player ?? '' };
  return template.replace(/\$(title|svg|player)/g, (name) => parts[name]);
}

export const playerOf = (source: string, looped: boolean) => `<audio controls${looped ? ' loop' : ''} src="${source}"></audio>`;

function dataUri({ data, mediaType }: PageSound): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(String(reader.result));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(new Blob([data], { type: mediaType }));
  });
}

const ENTITIES: Readonly<Record<string, string>> = { '&': '&amp;', '<': '&lt;', '>': '&gt;' };

const escaped = (text: string) => text.replace(/[&<>]/g, (character) => ENTITIES[character]);
