/** Speech in the editor: a sound becomes a track, lips move in step with it, visemes are edited, and exports carry the sound. */
import { readFile } from 'node:fs/promises';
import { expect, type Locator, type Page, test } from '@playwright/test';
import { ALL_FORMATS, BufferSource, Input } from 'mediabunny';
import type { SpeechTrack } from '../../web/src/speech/speechTrack';
import { expectNoViolations } from './axe';
import { systemChromium } from './chromium.mjs';
import { drag } from './editor';
import { bestLag, watchLipsAndSound } from './inStep';
import { keptWork } from './kept';
import { portraitFile } from './portrait';
import { SOUND_SECONDS, syllablesWav } from './sounds';

const chromium = systemChromium();
test.use({
  launchOptions: { ...chromium, args: [...(chromium.args ?? []), '--use-fake-device-for-media-stream', '--use-fake-ui-for-media-stream'] },
});

const visemes = (page: Page): Locator => page.getByRole('group', { name: 'Visemes' }).getByRole('button');
const labels = (page: Page): Promise<(string | null)[]> =>
  visemes(page).evaluateAll((blocks) => blocks.map((block) => block.getAttribute('aria-label')));

async function openPortrait(page: Page): Promise<void> {
  await page.goto('/');
  await giveFile(page, page.getByRole('button', { name: 'Open', exact: true }), 'numbers.vtalk', portraitFile());
  await page.getByRole('tab', { name: 'Speech' }).click();
}

async function exported(page: Page, label: string): Promise<Buffer> {
  await page.getByRole('button', { name: new RegExp(`^${label}`) }).click();
  const download = page.waitForEvent('download', { timeout: 60_000 });
  await page.getByRole('button', { name: 'Download' }).click();
  return readFile(await (await download).path());
}

/** Of pictures and of sound, to a tenth of a second. */
async function durations(video: Buffer): Promise<(number | undefined)[]> {
  const file = new Input({ source: new BufferSource(video), formats: ALL_FORMATS });
  const tracks = [await file.getPrimaryVideoTrack(), await file.getPrimaryAudioTrack()];
  return Promise.all(tracks.map(async (track) => track && Math.round(10 * (await track.computeDuration())) / 10)) as Promise<
    (number | undefined)[]
  >;
}

/** Of the track on the timeline, as the browser has stored it. */
async function keptSpeech(page: Page): Promise<{ tier?: string; visemes?: number }> {
  const track = (await keptWork(page))?.history.present.tracks[0] as SpeechTrack | undefined;
  return { tier: track?.tier, visemes: track?.visemes?.length };
}

async function giveFile(page: Page, button: Locator, name: string, buffer: Buffer): Promise<void> {
  const dialog = page.waitForEvent('filechooser');
  await button.click();
  await (await dialog).setFiles({ name, mimeType: 'application/octet-stream', buffer });
}

test('a sound becomes a track that is heard, seen, edited, undone, kept and exported', async ({ page }) => {
  test.slow();
  await watchLipsAndSound(page);
  await openPortrait(page);

  await test.step('a rough track at once, then blocks', async () => {
    await giveFile(page, page.getByRole('button', { name: 'Choose a sound…' }), 'syllables.wav', syllablesWav());
    await expect(page.getByRole('img', { name: 'Waveform' })).toBeVisible();
    await expect(page.getByText('Lips from the sound alone.')).toBeVisible({ timeout: 60_000 });
    expect((await labels(page)).filter((label) => !label?.startsWith('sil')).length).toBeGreaterThanOrEqual(4);
  });

  await test.step('lips open in step with what is heard', async () => {
    await page.getByRole('button', { name: 'Back to the start' }).click();
    await page.getByRole('button', { name: 'Play', exact: true }).click();
    await page.evaluate(() => window.lipsAndSound?.splice(0));
    await page.waitForFunction(
      ([seconds, leastFrames]) => {
        const frames = window.lipsAndSound ?? [];
        return frames.length > leastFrames && frames[frames.length - 1].time - frames[0].time > seconds;
      },
      [2 * SOUND_SECONDS, 80] as const, // machines that paint seldom play on for longer
    );
    await page.getByRole('button', { name: 'Pause' }).click();
    const found = bestLag(await page.evaluate(() => window.lipsAndSound ?? []));
    expect(found.correlation).toBeGreaterThan(0.7);
    expect(Math.abs(found.lagSeconds)).toBeLessThanOrEqual(0.06);
  });

  await test.step('a block is retimed by its edge: one step, undone whole', async () => {
    const before = await labels(page);
    const index = before.findIndex((label) => label?.startsWith('aa'));
    const box = await visemes(page).nth(index).boundingBox();
    if (!box) throw new Error('the block is not on the page');
    const edge = { x: box.x + box.width - 2, y: box.y + box.height / 2 };
    await drag(page, edge, { x: edge.x - 12, y: edge.y });
    await expect.poll(() => labels(page)).not.toEqual(before);
    await expect(page.getByText('Lips as you edited them.')).toBeVisible();
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(() => labels(page)).toEqual(before);
    await expect(page.getByText('Lips from the sound alone.')).toBeVisible();
  });

  await test.step('by keyboard, too: another viseme, later, removed', async () => {
    const before = await labels(page);
    const index = before.findIndex((label) => label?.startsWith('aa'));
    await visemes(page).nth(index).focus();
    await page.getByRole('combobox', { name: 'Viseme' }).selectOption('U');
    await expect.poll(async () => (await labels(page))[index]).toMatch(/^U,/);
    await visemes(page).nth(index).focus();
    await page.keyboard.press('Shift+ArrowRight');
    await page.keyboard.press('Delete');
    await expect.poll(() => labels(page)).toHaveLength(before.length - 1);
    for (const _ of ['removed', 'moved', 'changed']) await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(() => labels(page)).toEqual(before);
  });

  await test.step('a double click cuts a new block out of a vowel', async () => {
    const before = await labels(page);
    await visemes(page).filter({ hasText: 'aa' }).first().dblclick();
    await expect(page.getByRole('combobox', { name: 'Viseme' })).toHaveValue('PP');
    await expect(page.getByText('Lips as you edited them.')).toBeVisible();
    const closures = (all: readonly (string | null)[]) => all.filter((label) => label?.startsWith('PP')).length;
    expect(closures(await labels(page))).toBe(closures(before) + 1); // a short vowel is taken up by it whole
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(() => labels(page)).toEqual(before);
  });

  await test.step('a reload keeps sound and blocks', async () => {
    const before = await labels(page);
    await expect.poll(() => keptSpeech(page)).toEqual({ tier: 'audio', visemes: before.length });
    await page.reload();
    await expect.poll(() => labels(page)).toEqual(before);
    await expect(page.getByRole('img', { name: 'Waveform' })).toBeVisible();
  });

  await test.step('videos have a track of sound', async () => {
    await page.getByText('Export', { exact: true }).click();
    expect(await durations(await exported(page, 'MP4 video'))).toEqual([SOUND_SECONDS, SOUND_SECONDS]);
    await page.evaluate(() => Reflect.deleteProperty(window, 'VideoEncoder')); // the server renders, the browser adds the sound
    expect(await durations(await exported(page, 'MP4 video'))).toEqual([SOUND_SECONDS, SOUND_SECONDS]);
  });

  await test.step('a web page moves by the clock of its sound', async () => {
    const html = await exported(page, 'Web page');
    await page.route('**/exported.html', (route) => route.fulfill({ contentType: 'text/html', body: html }));
    await page.goto('/exported.html');
    const sound = page.locator('audio');
    await sound.evaluate(async (audio: HTMLAudioElement) => {
      audio.muted = true;
      await audio.play();
    });
    await expect.poll(() => sound.evaluate((audio: HTMLAudioElement) => audio.currentTime)).toBeGreaterThan(0.5);
    const late = await page.evaluate(() => {
      const svg = document.querySelector('svg');
      const audio = document.querySelector('audio');
      audio?.pause();
      return new Promise<number>((resolve) =>
        requestAnimationFrame(() => requestAnimationFrame(() => resolve((audio?.currentTime ?? 9) - (svg?.getCurrentTime() ?? 0)))),
      );
    });
    expect(Math.abs(late)).toBeLessThan(0.06);
  });
});

test('words of a part, manner, and files of other programs', async ({ page }) => {
  await openPortrait(page);
  await giveFile(page, page.getByRole('button', { name: 'Choose a sound…' }), 'syllables.wav', syllablesWav());
  await expect(page.getByText('Lips from the sound alone.')).toBeVisible({ timeout: 60_000 });
  await page.getByRole('button', { name: 'Pause' }).click();
  const heard = await labels(page);

  await test.step('a part is heard again, the rest stays', async () => {
    await visemes(page).filter({ hasText: 'aa' }).first().focus();
    await page.getByRole('combobox', { name: 'Viseme' }).selectOption('U');
    await expect(page.getByText('Lips as you edited them.')).toBeVisible();
    const waveform = await page.getByRole('img', { name: 'Waveform' }).boundingBox();
    if (!waveform) throw new Error('no waveform');
    const at = (seconds: number) => ({ x: waveform.x + (waveform.width * seconds) / SOUND_SECONDS, y: waveform.y + 10 });
    await drag(page, at(0), at(0.8));
    await page.getByRole('button', { name: 'Listen to this part' }).click();
    const edited = heard.findIndex((label) => label?.startsWith('aa'));
    await expect.poll(async () => (await labels(page))[edited], { timeout: 60_000 }).toEqual(heard[edited]);
    expect((await labels(page)).slice(-6)).toEqual(heard.slice(-6)); // a block across the end of the part is cut there
  });

  await test.step('a block edited while the part is being heard stays, and the editor says so', async () => {
    const edited = page.waitForResponse('**/api/tracks/visemes');
    await page.route('**/api/speech/*/result', async (route) => {
      await edited;
      await route.continue();
    });
    await page.getByRole('button', { name: 'Listen to this part' }).click();
    await visemes(page).filter({ hasText: 'aa' }).last().focus();
    await page.getByRole('combobox', { name: 'Viseme' }).selectOption('O');
    const kept = await labels(page);
    await expect(page.getByRole('main').getByText('was edited while it was being listened to')).toBeVisible();
    expect(await labels(page)).toEqual(kept);
    await page.unroute('**/api/speech/*/result');
    await page.getByRole('button', { name: 'All of it' }).click();
  });

  await test.step('a manner is one step, and the panel follows undo', async () => {
    await page.getByRole('radio', { name: 'Cartoon' }).check();
    await page.getByRole('button', { name: 'Mute head' }).click();
    await expect(page.getByText('Head', { exact: true }).first()).toBeVisible();
    await expect(page.locator('.lane-labels')).not.toContainText('Head');
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect(page.locator('.lane-labels')).toContainText('Head');
    await expect(page.getByRole('button', { name: 'Mute head' })).toHaveAttribute('aria-pressed', 'false');
  });

  await test.step('a track goes to Rhubarb and comes back with the sound', async () => {
    const download = page.waitForEvent('download');
    await page.getByRole('combobox', { name: 'Export the track' }).selectOption('Rhubarb TSV');
    const cues = await readFile(await (await download).path());
    expect(cues.toString()).toMatch(/^0\.00\tX\n/);
    await giveFile(page, page.getByRole('button', { name: 'Import a track…' }), 'cues.tsv', cues);
    await expect(page.getByRole('combobox', { name: 'Track', exact: true })).toHaveValue(/cues/);
    await expect(page.getByRole('img', { name: 'Waveform' })).toBeVisible();
    expect((await labels(page)).filter((label) => !label?.startsWith('sil')).length).toBeGreaterThanOrEqual(4);
  });

  await test.step('a project file keeps the sound', async () => {
    const download = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Save' }).click();
    const saved = await readFile(await (await download).path());
    await giveFile(page, page.getByRole('button', { name: 'Open', exact: true }), 'again.vtalk', saved);
    await expect(page.getByRole('button', { name: /^Undo: back to/ })).toBeEnabled(); // what was open gave way to it
    await expect(page.getByText('syllables.wav')).toBeVisible();
    await expect(page.getByText('3.0 s', { exact: true })).toBeVisible();
  });

  await test.step('axe finds nothing', () => expectNoViolations(page));
});

test('a file that is no sound is refused in one sentence, and the track stays', async ({ page }) => {
  await openPortrait(page);
  await giveFile(page, page.getByRole('button', { name: 'Choose a sound…' }), 'notes.mp3', Buffer.from('not a sound'));
  await expect(page.getByRole('alert')).toContainText('notes.mp3 is no sound that this browser can play');
  await expect(page.getByRole('combobox', { name: 'Track', exact: true })).toHaveValue(/Nod/);
  await expect(page.getByRole('button', { name: 'Choose a sound…' })).toBeEnabled();
});

test('the microphone is recorded, spoken, and deleted with the portrait', async ({ page, request }) => {
  await openPortrait(page);
  const sent = page.waitForResponse((response) => response.url().endsWith('/api/recordings'));
  await page.getByRole('radio', { name: 'Record' }).check();
  await page.getByRole('button', { name: 'Start recording' }).click();
  await expect
    .poll(() => page.getByRole('meter', { name: 'Loudness of the microphone' }).evaluate((bar: HTMLMeterElement) => bar.value))
    .toBeGreaterThan(0.2);
  await expect(page.getByText(/^[2-9]\.\d s$/)).toBeVisible(); // a beep or two of the fake microphone
  await page.getByRole('button', { name: 'Stop and use it' }).click();
  await expect(page.getByRole('combobox', { name: 'Track', exact: true })).toHaveValue(/Recording/);
  await expect(page.getByText('Lips from the sound alone.')).toBeVisible({ timeout: 60_000 });
  const { id } = (await (await sent).json()) as { id: string };
  expect((await request.get(`/api/recordings/${id}`)).status()).toBe(200);
  await page.getByRole('button', { name: 'Delete this portrait' }).click();
  await page.getByRole('status').getByRole('button', { name: 'Delete' }).click();
  await expect.poll(async () => (await request.get(`/api/recordings/${id}`)).status()).toBe(404);
});
