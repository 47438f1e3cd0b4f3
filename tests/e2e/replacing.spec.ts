/** A picture that takes the place of the open portrait is a step: undo brings the portrait back, with all its own steps. */
import { expect, type Page, test } from '@playwright/test';
import { pathData } from './editor';
import { gradientPng } from './plainPicture';
import { openPortraitOfNumbers } from './portrait';

const jaw = (page: Page) => page.getByRole('spinbutton', { name: 'Jaw, value' });
const pins = (page: Page) => page.getByRole('region', { name: 'Five pins' });
const backTo = (page: Page, step: 'Undo' | 'Redo', name: string) => page.getByRole('button', { name: `${step}: back to “${name}”` });

/** As a file manager does it. */
async function dropOnStage(page: Page, name: string, picture: Buffer): Promise<void> {
  const files = await page.evaluateHandle(
    ([base64, fileName]) => {
      const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
      const transfer = new DataTransfer();
      transfer.items.add(new File([bytes], fileName, { type: 'image/png' }));
      return transfer;
    },
    [picture.toString('base64'), name] as const,
  );
  await page.getByRole('main', { name: 'Stage' }).dispatchEvent('drop', { dataTransfer: files });
}

test.beforeEach(async ({ page }) => {
  await openPortraitOfNumbers(page);
  await page.getByRole('button', { name: 'Surprised' }).click();
  await expect(jaw(page)).toHaveValue('0.60');
});

test('undo brings the portrait back with its steps, redo the picture, and both outlast a reload', async ({ page }) => {
  const surprised = await pathData(page);
  await dropOnStage(page, 'plain.png', gradientPng(96));
  await expect(pins(page)).toBeVisible();
  await backTo(page, 'Undo', 'Numbers').click();
  await expect.poll(() => pathData(page)).toEqual(surprised);
  await page.getByRole('button', { name: 'Undo', exact: true }).click();
  await expect(jaw(page)).toHaveValue('0.00');
  await page.getByRole('button', { name: 'Redo', exact: true }).click();
  await expect(jaw(page)).toHaveValue('0.60');
  await backTo(page, 'Redo', 'plain').click();
  await expect(pins(page)).toBeVisible();
  await page.reload();
  await expect(pins(page)).toBeVisible();
  await backTo(page, 'Undo', 'Numbers').click();
  await expect.poll(() => pathData(page)).toEqual(surprised);
});

test('a word on the stage says what gave way, and brings it back', async ({ page }) => {
  await dropOnStage(page, 'plain.png', gradientPng(96));
  await page.getByRole('status').getByRole('button', { name: 'Bring it back' }).click();
  await expect(jaw(page)).toHaveValue('0.60');
});

test('a picture on its way is taken back by undo', async ({ page }) => {
  await page.route('**/api/portraits', () => {}); // a server that is slow to answer
  await dropOnStage(page, 'plain.png', gradientPng(96));
  await expect(page.getByText('Sending the picture…')).toBeVisible();
  await page.getByRole('button', { name: 'Undo', exact: true }).click();
  await expect(page.getByText('Sending the picture…')).toBeHidden();
  await expect(jaw(page)).toHaveValue('0.60');
});

test('when the picture is deleted, the portrait waits behind the first screen', async ({ page }) => {
  await dropOnStage(page, 'plain.png', gradientPng(96));
  await expect(pins(page)).toBeVisible();
  await page.getByRole('button', { name: 'Delete this portrait' }).click();
  await page.getByRole('status').getByRole('button', { name: 'Delete' }).click();
  await page.getByRole('button', { name: 'Go on with “Numbers”' }).click();
  await expect(jaw(page)).toHaveValue('0.60');
  await expect(page.getByRole('button', { name: 'Redo' })).toBeDisabled();
});
