/** Who looks at another tab is told when the tracing is done. */
import { expect, type Page, test } from '@playwright/test';
import { openEditor, tracingDone } from './editor';

declare global {
  interface Window {
    isAway: boolean;
    notified: string[];
  }
}

/** Headless Chromium never hides a tab, and shows no notifications: both are stood in for, before the page runs. */
async function standInForTabAndNotifications(page: Page): Promise<void> {
  await page.addInitScript(() => {
    window.isAway = false;
    window.notified = [];
    Object.defineProperty(document, 'visibilityState', { get: () => (window.isAway ? 'hidden' : 'visible') });
    window.Notification = class {
      static permission = 'default';
      static requestPermission = async () => 'granted';
      constructor(title: string) {
        window.notified.push(title);
      }
    } as unknown as typeof Notification;
  });
}

function leave(page: Page, isAway: boolean): Promise<void> {
  return page.evaluate((away) => {
    window.isAway = away;
    document.dispatchEvent(new Event('visibilitychange'));
  }, isAway);
}

test('the end of a tracing is told in the title and by the notification that was asked for', async ({ page }) => {
  await standInForTabAndNotifications(page);
  await openEditor(page);
  await page.getByRole('region', { name: 'Samples' }).getByRole('button').first().click();
  await page.getByRole('button', { name: 'Notify me' }).click();
  await expect(page.getByRole('button', { name: 'Will notify you' })).toBeDisabled();
  await leave(page, true);
  await tracingDone(page);
  await expect(page).toHaveTitle(/^done, \d+ paths/);
  expect(await page.evaluate(() => window.notified)).toEqual([expect.stringMatching(/: done, \d+ paths$/)]);
  await leave(page, false);
  await expect(page).toHaveTitle('VectorTalker');
});
