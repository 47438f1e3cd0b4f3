/** What is said can be read: on the stage, on exported pages, in videos, and as a file of its own. */
import { readFile, writeFile } from 'node:fs/promises';
import { expect, type Page, test } from '@playwright/test';
import { openPortraitOfNumbers, speakingPortraitFile } from './portrait';
import { SOUND_SECONDS } from './sounds';

/** The second sentence begins with the third syllable. */
const VTT = `WEBVTT

00:00:00.400 --> 00:00:01.500
Ba, ba &amp; no more.

00:00:01.500 --> 00:00:03.000
Ba, ba, ba, &lt;b&gt;ba&lt;/b&gt;!
`;

test.beforeEach(({ page }) => openPortraitOfNumbers(page, speakingPortraitFile('Ba, ba & no more. Ba, ba, ba, <b>ba</b>!')));

async function exported(page: Page, label: string): Promise<{ data: Buffer; name: string }> {
  await page.getByText('Export', { exact: true }).click();
  await page
    .getByRole('region', { name: 'Export' })
    .getByRole('button', { name: new RegExp(`^${label}`) })
    .click();
  const downloading = page.waitForEvent('download', { timeout: 60_000 });
  await page.getByRole('button', { name: 'Download' }).click();
  const download = await downloading;
  return { data: await readFile(await download.path()), name: download.suggestedFilename() };
}

test('the stage shows them at the playhead, until they are put away', async ({ page }) => {
  const playhead = page.getByRole('slider', { name: 'Playhead' });
  const stage = page.getByRole('main', { name: 'Stage' });
  await playhead.fill('0.6');
  await expect(stage.getByText('Ba, ba & no more.')).toBeVisible();
  await playhead.fill('2');
  await expect(stage.getByText('Ba, ba, ba, <b>ba</b>!')).toBeVisible();
  await page.getByRole('button', { name: 'Captions' }).click();
  await expect(stage.getByText('Ba, ba')).toBeHidden();
  await stage.press('w');
  await expect(stage.getByText('Ba, ba')).toBeVisible();
  await playhead.fill('0.2');
  await expect(stage.getByText('Ba, ba')).toBeHidden();
});

test('a WebVTT file holds them', async ({ page }) => {
  const { data, name } = await exported(page, 'Captions');
  expect(name).toBe('Numbers.vtt');
  expect(data.toString()).toBe(VTT);
});

test('an exported page writes them below the picture, opened from a disk', async ({ page }, testInfo) => {
  const { data } = await exported(page, 'Web page');
  const file = testInfo.outputPath('talk.html');
  await writeFile(file, data);
  await page.goto(`file://${file}`);
  const seek = (seconds: number) =>
    page.locator('audio').evaluate((audio: HTMLAudioElement, to) => {
      audio.currentTime = to;
    }, seconds);
  const words = page.locator('main > p');
  await seek(0.6);
  await expect(words).toHaveText('Ba, ba & no more.');
  await seek(2);
  await expect(words).toHaveText('Ba, ba, ba, <b>ba</b>!');
  await seek(0);
  await expect(words).toBeEmpty();
});

test('an animated SVG says them to who does not see it', async ({ page }) => {
  const { data } = await exported(page, 'Animated SVG');
  expect(data.toString()).toContain('It says: “Ba, ba &amp; no more. Ba, ba, ba, &lt;b&gt;ba&lt;/b&gt;!”');
});

for (const { label, marks } of [
  { label: 'MP4 video', marks: ['wvtt', 'payl'] }, // ISO 14496-30
  { label: 'WebM video', marks: ['S_TEXT/WEBVTT'] },
])
  test(`${label} carries them as a track`, async ({ page }) => {
    const { data } = await exported(page, label);
    for (const text of [...marks, 'Ba, ba &amp; no more.', 'Ba, ba, ba, &lt;b&gt;ba']) expect(data.includes(text), text).toBe(true);
    expect(await playedSeconds(page, data)).toBeCloseTo(SOUND_SECONDS, 1);
  });

/** The length of a video that the browser has played to its end. */
function playedSeconds(page: Page, video: Buffer): Promise<number> {
  return page.evaluate(async (base64) => {
    const element = document.createElement('video');
    element.muted = true;
    element.playbackRate = 8;
    const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    element.src = URL.createObjectURL(new Blob([bytes]));
    await new Promise((resolve, reject) => {
      element.onended = resolve;
      element.onerror = () => reject(element.error);
      element.play().catch(reject);
    });
    return element.currentTime;
  }, video.toString('base64'));
}
