/** Keyframes: a pose becomes part of the track, stays on the stage, plays, is saved and can be taken away. */
import { expect, test } from '@playwright/test';
import { pathData, settled } from './editor';
import { portraitFile } from './portrait';

test('the pose that is set becomes a keyframe at the playhead', async ({ page }) => {
  await page.goto('/');
  const open = async (file: string | { name: string; mimeType: string; buffer: Buffer }) => {
    const dialog = page.waitForEvent('filechooser');
    await page.getByRole('button', { name: 'Open', exact: true }).click();
    await (await dialog).setFiles(file);
  };
  await open({ name: 'numbers.vtalk', mimeType: 'application/zip', buffer: portraitFile() });
  const playhead = page.getByRole('slider', { name: 'Playhead' });
  const corners = page.getByRole('spinbutton', { name: 'Corners, value' });
  const keyframe = page.getByRole('button', { name: 'Keyframe at 0.40 seconds' });
  await playhead.fill('0.4');
  await page.getByRole('button', { name: 'Smile', exact: true }).click();
  await settled(page);
  const smiling = await pathData(page);

  await test.step('I moves it into the track', async () => {
    await page.getByRole('main', { name: 'Stage' }).press('i');
    await expect(keyframe).toBeVisible();
    await expect(corners).toHaveValue('0.00');
    await settled(page);
    expect(await pathData(page)).toEqual(smiling);
  });

  await test.step('it is saved and opens again', async () => {
    const download = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Save' }).click();
    await open(await (await download).path());
    await expect(keyframe).toBeVisible();
    await keyframe.click();
    await expect.poll(() => pathData(page)).toEqual(smiling);
  });

  await test.step('the pin of a slider keys that channel alone', async () => {
    await playhead.fill('0.8');
    await corners.fill('0.5');
    await corners.press('Enter');
    await page.getByRole('spinbutton', { name: 'Width, value' }).fill('0.3');
    await page.getByRole('button', { name: 'Keyframe of corners, frown to smile' }).click();
    await expect(page.getByRole('button', { name: 'Keyframe at 0.80 seconds' })).toBeVisible();
    await expect(corners).toHaveValue('0.00');
    await expect(page.getByRole('spinbutton', { name: 'Width, value' })).toHaveValue('0.30');
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect(page.getByRole('button', { name: 'Keyframe at 0.80 seconds' })).toBeHidden();
    await keyframe.click();
  });

  await test.step('Delete takes it away, and undo brings it back', async () => {
    await keyframe.press('Delete');
    await expect(keyframe).toBeHidden();
    await expect.poll(() => pathData(page)).not.toEqual(smiling);
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect(keyframe).toBeVisible();
  });
});
