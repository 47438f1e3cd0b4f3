/** The tool that corrects the rest hides poses, so whatever poses the portrait takes the pose tool. */
import { expect, test } from '@playwright/test';
import { pathData, settled } from './editor';
import { openPortraitOfNumbers } from './portrait';

test.beforeEach(async ({ page }) => {
  await openPortraitOfNumbers(page);
  await page.getByRole('button', { name: 'Adjust the landmarks' }).click();
  await settled(page);
});

test('scrubbing shows the track', async ({ page }) => {
  const rest = await pathData(page);
  await page.getByRole('slider', { name: 'Playhead' }).fill('0.6');
  await expect.poll(() => pathData(page)).not.toEqual(rest);
});

test('playing shows the track', async ({ page }) => {
  const rest = await pathData(page);
  await page.getByRole('button', { name: 'Play', exact: true }).click();
  await expect.poll(() => pathData(page)).not.toEqual(rest);
});

test('a preset shows its pose', async ({ page }) => {
  const rest = await pathData(page);
  await page.getByRole('button', { name: 'Surprised' }).click();
  await expect.poll(() => pathData(page)).not.toEqual(rest);
});
