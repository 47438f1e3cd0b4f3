/** What is under way when the page is reloaded goes on. */
import { expect, type Page, test } from '@playwright/test';
import { landmark, openEditor, tracingDone } from './editor';

test('a reload while the face is looked for loses nothing', async ({ page }) => {
  await openEditor(page);
  await page.route('**/api/portraits/*/faces', () => {}); // a server that is slow to answer
  await page.getByRole('region', { name: 'Samples' }).getByRole('button').first().click();
  await expect(page.getByText('Looking for the face…')).toBeVisible();
  await expect.poll(() => hasKeptWork(page)).toBe(true);
  await page.unroute('**/api/portraits/*/faces');
  await page.reload();
  await tracingDone(page);
  await expect(landmark(page, 'Nose tip')).toBeAttached();
});

/** A picture takes the browser a moment to store; a page that is left before has nothing to come back to. */
function hasKeptWork(page: Page): Promise<boolean> {
  return page.evaluate(
    () =>
      new Promise((resolve, reject) => {
        const opening = indexedDB.open('vectortalker');
        opening.onerror = () => reject(opening.error);
        opening.onsuccess = () => {
          const current = opening.result.transaction('pointer').objectStore('pointer').get('current');
          current.onsuccess = () => {
            opening.result.close();
            resolve(current.result !== undefined);
          };
        };
      }),
  );
}
