/** Speech in the editor: a sound becomes a track, lips move in step with it, visemes are edited, and exports carry the sound. */
import { readFile } from 'node:fs/promises';
import { expect, type Locator, type Page, test } from '@playwright/test';
import { ALL_FORMATS, BufferSource, Input } from 'mediabunny';
import { systemChromium } from './chromium.mjs';
import { drag } from './editor';
import { bestLag, watchLipsAndSound } from './inStep';
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

async function giveFile(page: Page, button: Locator, name: string, buffer: Buffer): Promise<void> {
  const dialog = page.waitForEvent('filechooser');
  await button.click();
  await (await dialog).setFiles({ name, mimeType: 'application/octet-stream', buffer });
}

test('a sound becomes a track that is heard, seen, edited, undone, kept and exported', async ({ page }) => {
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
      (seconds) => (window.lipsAndSound?.at(-1)?.time ?? 0) - (window.lipsAndSound?.[0].time ?? 0) > seconds,
      2 * SOUND_SECONDS, // twice, so that slow machines paint enough
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

  await test.step('a reload keeps sound and blocks', async () => {
    const before = await labels(page);
    await page.waitForTimeout(600); // the save is put off for 250 ms
    await page.reload();
    await expect.poll(() => labels(page)).toEqual(before);
    await expect(page.getByRole('img', { name: 'Waveform' })).toBeVisible();
  });

  await test.step('MP4 has a track of sound', async () => {
    await page.getByText('Export', { exact: true }).click();
    await page.getByRole('button', { name: /^MP4 video/ }).click();
    const download = page.waitForEvent('download', { timeout: 60_000 });
    await page.getByRole('button', { name: 'Download' }).click();
    const file = new Input({ source: new BufferSource(await readFile(await (await download).path())), formats: ALL_FORMATS });
    const sound = await file.getPrimaryAudioTrack();
    expect(await sound?.computeDuration()).toBeCloseTo(SOUND_SECONDS, 1);
  });
});

test('the microphone is recorded and spoken', async ({ page }) => {
  await openPortrait(page);
  await page.getByRole('radio', { name: 'Record' }).check();
  await page.getByRole('button', { name: 'Start recording' }).click();
  await expect
    .poll(() => page.getByRole('meter', { name: 'Loudness of the microphone' }).evaluate((bar: HTMLMeterElement) => bar.value))
    .toBeGreaterThan(0.2);
  await page.waitForTimeout(1200);
  await page.getByRole('button', { name: 'Stop and use it' }).click();
  await expect(page.getByRole('combobox', { name: 'Track', exact: true })).toHaveValue(/Recording/);
  await expect(page.getByText('Lips from the sound alone.')).toBeVisible({ timeout: 60_000 });
});
