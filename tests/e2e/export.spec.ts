/** Exports: each is downloaded, opened by other means than those that made it, and seen to move. */
import { readFile } from 'node:fs/promises';
import { type Download, expect, type Page, test } from '@playwright/test';
import { ALL_FORMATS, BufferSource, Input } from 'mediabunny';
import { difference } from './pixels';
import { portraitFile } from './portrait';

const DURATION = 1.2; // seconds of the portrait's track
const FPS = 25;

test.beforeEach(async ({ page }) => {
  await page.goto('/');
  const dialog = page.waitForEvent('filechooser');
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await (await dialog).setFiles({ name: 'numbers.vtalk', mimeType: 'application/zip', buffer: portraitFile() });
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
  await page.waitForTimeout(400); // a third of the track
  const moved = await difference(page, first, await image.screenshot({ animations: 'allow' }));
  expect(moved.count).toBeGreaterThan(500);
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
  await page.getByRole('button', { name: /^MP4 video/ }).click();
  await expect(page.getByText(/about .* (kB|MB)/)).toBeVisible();
  await page.getByRole('button', { name: 'Download' }).click();
  await page.getByRole('button', { name: 'Cancel' }).click();
  await expect(page.getByRole('button', { name: /^MP4 video/ })).toBeVisible();
  expect(downloads).toBe(0);
});

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
