/** What is under way when the page is reloaded goes on. */
import { expect, test } from '@playwright/test';
import { chooseFile, landmark, openEditor, tracingDone } from './editor';
import { keptWork } from './kept';
import { openPortraitOfNumbers } from './portrait';
import { syllablesWav } from './sounds';

test('a reload while the face is looked for loses nothing', async ({ page }) => {
  await openEditor(page);
  await page.route('**/api/portraits/*/faces', () => {}); // a server that is slow to answer
  await page.getByRole('region', { name: 'Samples' }).getByRole('button').first().click();
  await expect(page.getByText('Looking for the face…')).toBeVisible();
  await expect.poll(() => keptWork(page)).not.toBeNull(); // a page that is left before has nothing to come back to
  await page.unroute('**/api/portraits/*/faces');
  await page.reload();
  await tracingDone(page);
  await expect(landmark(page, 'Nose tip')).toBeAttached();
});

test('a reload while the picture is sent loses nothing', async ({ page }) => {
  await openEditor(page);
  await page.route('**/api/portraits', () => {}); // a server that is slow to answer
  await page.getByRole('region', { name: 'Samples' }).getByRole('button').first().click();
  await expect(page.getByText('Sending the picture…')).toBeVisible();
  await expect.poll(() => keptWork(page)).not.toBeNull(); // a page that is left before has nothing to come back to
  await page.unroute('**/api/portraits');
  await page.reload();
  await tracingDone(page);
  await expect(landmark(page, 'Nose tip')).toBeAttached();
});

test('a reload while speech is listened to goes on with the work that the server has begun', async ({ page }) => {
  await openPortraitOfNumbers(page);
  await page.route('**/api/jobs/*/events', () => {}); // a server that is slow to answer
  await page.getByRole('tab', { name: 'Speech' }).click();
  await page.getByRole('textbox', { name: 'What is said' }).fill('ba ba');
  const dialog = page.waitForEvent('filechooser');
  const asked = page.waitForResponse('**/api/speech');
  await page.getByRole('button', { name: 'Choose a sound…' }).click();
  await (await dialog).setFiles({ name: 'syllables.wav', mimeType: 'audio/wav', buffer: syllablesWav() });
  const { id } = (await (await asked).json()) as { id: string };
  await expect.poll(async () => (await keptWork(page))?.speech?.hearing?.jobId).toBe(id);
  await page.unroute('**/api/jobs/*/events');
  let asksAgain = 0;
  page.on('request', (request) => {
    if (request.url().endsWith('/api/speech')) asksAgain += 1;
  });
  await page.reload();
  await page.getByRole('tab', { name: 'Speech' }).click();
  await expect(page.getByRole('textbox', { name: 'What is said' })).toHaveValue('ba ba');
  await expect(page.getByText('Lips from the sound and its words.')).toBeVisible({ timeout: 60_000 });
  expect(asksAgain).toBe(0);
});

test('a portrait that was left for the first screen waits there, after a refused file and a reload too', async ({ page }) => {
  await openPortraitOfNumbers(page);
  await page.getByRole('button', { name: 'Surprised' }).click();
  await page.getByRole('button', { name: 'VectorTalker: start with another portrait' }).click();
  await expect(page.getByRole('button', { name: 'Choose a file' })).toBeVisible();
  await page.keyboard.press('Control+z'); // no key reaches what is not on the stage
  await chooseFile(page, { name: 'notes.png', mimeType: 'image/png', buffer: Buffer.from('not a picture') });
  await expect(page.getByRole('alert')).toContainText('notes.png');
  await page.reload();
  await page.getByRole('button', { name: 'Go on with “Numbers”' }).click();
  await expect(page.getByRole('spinbutton', { name: 'Jaw, value' })).toHaveValue('0.60');
});
