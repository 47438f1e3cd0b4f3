/** What is under way when the page is reloaded goes on. */
import { expect, test } from '@playwright/test';
import { landmark, openEditor, tracingDone } from './editor';

test('a reload while the face is looked for loses nothing', async ({ page }) => {
  await openEditor(page);
  await page.route('**/api/portraits/*/faces', () => {}); // a server that is slow to answer
  await page.getByRole('region', { name: 'Samples' }).getByRole('button').first().click();
  await expect(page.getByText('Looking for the face…')).toBeVisible();
  await page.unroute('**/api/portraits/*/faces');
  await page.reload();
  await tracingDone(page);
  await expect(landmark(page, 'Nose tip')).toBeAttached();
});
