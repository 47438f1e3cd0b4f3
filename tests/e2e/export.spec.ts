/** Exports: each is downloaded, opened by other means than those that made it, and seen to move. */
import { readFile } from 'node:fs/promises';
import { type Download, expect, type Page, test } from '@playwright/test';
import { ALL_FORMATS, BufferSource, Input } from 'mediabunny';
import { difference } from './pixels';
import { openPortraitOfNumbers } from './portrait';

const DURATION = 1.2; // seconds of the portrait's track
const FPS = 25;

test.beforeEach(async ({ page }) => {
  await openPortraitOfNumbers(page);
  await page.getByText('Export', { exact: true }).click();
});

test('still SVG holds the three layers', async ({ page }) => {
  const svg = (await readFile(await (await exported(page, 'SVG')).path())).toString();
  const groups = await page.evaluate((text) => {
    const root = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
    return Array.from(root.children, ({ id }) => id).filter(Boolean);
  }, svg);
  expect(groups).toEqual(['back', 'fore', 'local']);
});

test('animated SVG moves in an img', async ({ page }) => {
  const svg = await readFile(await (await exported(page, 'Animated SVG')).path());
  expect(svg.toString()).not.toContain('<script');
  const image = page.getByRole('img', { name: 'exported' });
  await page.setContent(`<img alt="exported" width="240" src="data:image/svg+xml;base64,${svg.toString('base64')}">`);
  const first = await image.screenshot({ animations: 'allow' });
  const moved = async () => (await difference(page, first, await image.screenshot({ animations: 'allow' }))).count;
  await expect.poll(moved).toBeGreaterThan(500); // two shots may be whole turns apart
});

test('animated SVG leaves hidden layers out and keeps opacity', async ({ page }) => {
  await showLayers(page);
  const svg = (await readFile(await (await exported(page, 'Animated SVG')).path())).toString();
  const layers = await page.evaluate((text) => {
    const root = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
    return ['back', 'fore', 'local'].map((id) => {
      const layer = root.querySelector(`#${id}`);
      return { paths: layer?.querySelectorAll('path:not(clipPath *)').length, opacity: layer?.getAttribute('opacity') };
    });
  }, svg);
  expect(layers).toEqual([
    { paths: 1, opacity: '0.5' },
    { paths: 0, opacity: null },
    { paths: 5, opacity: null },
  ]);
});

test('a video leaves hidden layers out and keeps opacity', async ({ page }) => {
  await showLayers(page);
  const video = await readFile(await (await exported(page, 'WebM video')).path());
  const [cheek, sky] = await coloursIn(page, video, [
    [100, 250],
    [60, 40],
  ]);
  expectNear(cheek, [0x30, 0x40, 0x50]); // the canvas: the skin is hidden
  expectNear(sky, [0x40, 0x60, 0x80]); // half of #5080b0 over the canvas
});

for (const { label, codec } of [
  { label: 'MP4 video', codec: 'avc' },
  { label: 'WebM video', codec: 'vp9' },
]) {
  test(`${label} made in the browser has all its frames`, async ({ page }) => {
    const video = await opened(await exported(page, label));
    expect(await video.codec).toBe(codec);
    expect(video.packets).toBe(DURATION * FPS);
  });
}

test('without an encoder the server renders the video', async ({ page }) => {
  await page.evaluate(() => Reflect.deleteProperty(window, 'VideoEncoder'));
  await page.getByRole('button', { name: /^MP4 video/ }).click();
  await expect(page.getByText('the server will render it')).toBeVisible();
  const download = page.waitForEvent('download', { timeout: 60_000 });
  await page.getByRole('button', { name: 'Download' }).click();
  expect((await opened(await download)).packets).toBe(DURATION * FPS);
});

test('a forecast comes first, and Cancel goes back without a file', async ({ page }) => {
  let downloads = 0;
  page.on('download', () => {
    downloads += 1;
  });
  await page.keyboard.press('Escape');
  await page.getByRole('combobox', { name: 'Track' }).selectOption({ label: 'Demo: blink, smile, speak, tilt' });
  await page.getByText('Export', { exact: true }).click();
  await page.getByRole('combobox', { name: 'Video size' }).selectOption('1080 px'); // with eight seconds, slow enough to be cancelled
  await page.getByRole('button', { name: /^MP4 video/ }).click();
  await expect(page.getByText(/about .* (kB|MB)/)).toBeVisible();
  await page.getByRole('button', { name: 'Download' }).click();
  await page.getByRole('button', { name: 'Cancel' }).click();
  await expect(page.getByRole('button', { name: /^MP4 video/ })).toBeVisible();
  expect(downloads).toBe(0);
});

/** Hides the fore and lets half of the canvas through the back. */
async function showLayers(page: Page): Promise<void> {
  await page.keyboard.press('Escape');
  await page.getByRole('tab', { name: 'Layers' }).click();
  await page.getByRole('button', { name: 'Show fore' }).click();
  const opacity = page.getByRole('slider', { name: 'Opacity of back' });
  await opacity.fill('0.5');
  await opacity.dispatchEvent('change');
  await page.getByText('Export', { exact: true }).click();
}

/** Colours of a video of the portrait at points of it. */
function coloursIn(page: Page, video: Buffer, points: readonly (readonly [number, number])[]): Promise<number[][]> {
  return page.evaluate(
    async ([base64, at]) => {
      const element = document.createElement('video');
      const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
      element.src = URL.createObjectURL(new Blob([bytes], { type: 'video/webm' }));
      element.currentTime = 0.2; // a seek ends with a frame that can be drawn
      await new Promise((resolve, reject) => {
        element.onseeked = resolve;
        element.onerror = reject;
      });
      const canvas = new OffscreenCanvas(element.videoWidth, element.videoHeight);
      const context = canvas.getContext('2d');
      if (!context) throw new Error('no 2D context');
      context.drawImage(element, 0, 0);
      const scale = element.videoWidth / 240;
      return at.map(([x, y]) => [...context.getImageData(x * scale, y * scale, 1, 1).data].slice(0, 3));
    },
    [video.toString('base64'), points] as const,
  );
}

function expectNear(colour: readonly number[], expected: readonly number[]): void {
  const codecLoss = 12; // levels of 255
  for (const [channel, level] of colour.entries()) expect(Math.abs(level - expected[channel])).toBeLessThan(codecLoss);
}

async function exported(page: Page, label: string): Promise<Download> {
  await page.getByRole('button', { name: new RegExp(`^${label}`) }).click();
  const download = page.waitForEvent('download', { timeout: 60_000 });
  await page.getByRole('button', { name: 'Download' }).click();
  return download;
}

async function opened(download: Download): Promise<{ codec: string | null; packets: number }> {
  const data = await readFile(await download.path());
  const track = await new Input({ source: new BufferSource(data), formats: ALL_FORMATS }).getPrimaryVideoTrack();
  if (!track) throw new Error('no video track');
  return { codec: await track.getCodec(), packets: (await track.computePacketStats()).packetCount };
}
