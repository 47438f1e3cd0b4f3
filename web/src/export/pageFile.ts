/** Puts an animated SVG, and sound if there is any, into one web page that needs no other file. */

/** With sound its clock leads: the time of the SVG is set from it before every paint. */
const FOLLOWING = `const svg = document.querySelector('svg')
  const audio = document.querySelector('audio')
  const follow = () => {
    svg.setCurrentTime(audio.currentTime)
    if (!audio.paused) requestAnimationFrame(follow)
  }
  svg.pauseAnimations()
  audio.addEventListener('play', follow)
  audio.addEventListener('seeked', follow)`;

const PLAYING = `const svg = document.querySelector('svg')
  const toggle = () => (svg.animationsPaused() ? svg.unpauseAnimations() : svg.pauseAnimations())
  if (matchMedia('(prefers-reduced-motion: reduce)').matches) svg.pauseAnimations()
  svg.addEventListener('click', toggle)
  document.addEventListener('keydown', (event) => event.key === ' ' && toggle())`;

export type PageSound = { readonly data: Blob; readonly mediaType: string; readonly looped: boolean };

/** The text of the page round an animated `svg`, which must not repeat by itself where there is sound. */
export async function pageFile(svg: string, title: string, sound: PageSound | null): Promise<string> {
  const player = sound && `<audio controls${sound.looped ? ' loop' : ''} src="${await dataUri(sound)}"></audio>`;
  return `<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escaped(title)}</title>
<style>
  body { margin: 0; min-height: 100vh; display: grid; place-content: center; gap: 1rem; background: Canvas }
  svg { display: block; width: auto; height: auto; max-width: 100vw; max-height: calc(100vh - 5rem) }
  audio { width: 100% }
</style>
<main>
${svg}
${player ?? ''}
</main>
<script>
  ${sound ? FOLLOWING : PLAYING}
</script>
</html>
`;
}

function dataUri({ data, mediaType }: PageSound): Promise<string> {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(String(reader.result));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(new Blob([data], { type: mediaType }));
  });
}

const escaped = (text: string) => text.replace(/[&<>]/g, (character) => `&#${character.charCodeAt(0)};`);
