/** The browser keeps the work: through a reload at any moment, beside a second page, and with a word where it cannot. */
import { expect, type Page, test } from '@playwright/test';
import { keptWork } from './kept';
import { openPortraitOfNumbers } from './portrait';

const jaw = (page: Page) => page.getByRole('spinbutton', { name: 'Jaw, value' });
const name = (page: Page) => page.getByRole('textbox', { name: 'Name of the portrait' });

async function rename(page: Page, to: string): Promise<void> {
  await name(page).fill(to);
  await name(page).press('Enter');
}

test('what was changed the moment before a reload is there after it', async ({ page }) => {
  await openPortraitOfNumbers(page);
  await page.getByRole('button', { name: 'Surprised' }).click();
  await page.reload();
  await expect(jaw(page)).toHaveValue('0.60');
  await page.getByRole('button', { name: 'Undo' }).click();
  await expect(jaw(page)).toHaveValue('0.00');
});

test('of two pages, the last to change something is kept whole', async ({ page, context }) => {
  await openPortraitOfNumbers(page);
  await rename(page, 'first');
  const second = await context.newPage();
  await expect(async () => {
    await second.goto('/');
    await expect(name(second)).toHaveValue('first', { timeout: 2000 });
  }).toPass();
  await rename(second, 'second');
  await expect.poll(async () => (await keptWork(second))?.history.present.name).toBe('second');
  await rename(page, 'first again');
  await page.reload();
  await expect(name(page)).toHaveValue('first again');
  await page.getByRole('button', { name: 'Surprised' }).click();
  await expect(jaw(page)).toHaveValue('0.60');
});

test('a browser that cannot keep the work says so, and a file still can', async ({ page }) => {
  await openPortraitOfNumbers(page);
  const devtools = await page.context().newCDPSession(page);
  await devtools.send('Storage.clearDataForOrigin', { origin: new URL(page.url()).origin, storageTypes: 'indexeddb' });
  await page.getByRole('button', { name: 'Surprised' }).click();
  await expect(page.getByRole('alert')).toContainText('Save it as a file before you leave.');
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save' }).click();
  expect((await download).suggestedFilename()).toBe('Numbers.vtalk');
});
