/** Who looks at another tab is told when the tracing is done. */
import { expect, type Page, test } from '@playwright/test';
import { openEditor, tracingDone } from './editor';

declare global {
  interface Window {
    isAway: boolean;
    notified: string[];
    notes: number;
  }
}

/** Headless Chromium never hides a tab, shows no notifications and is not heard: all are stood in for, before the page runs. */
async function standInForTabAndNotifications(page: Page, answer: NotificationPermission): Promise<void> {
  await page.addInitScript((answer) => {
    window.isAway = false;
    window.notified = [];
    window.notes = 0;
    const { start } = OscillatorNode.prototype;
    OscillatorNode.prototype.start = function (when) {
      window.notes += 1;
      start.call(this, when);
    };
    Object.defineProperty(document, 'visibilityState', { get: () => (window.isAway ? 'hidden' : 'visible') });
    class Notified {
      static permission: NotificationPermission = 'default';
      static async requestPermission() {
        Notified.permission = answer;
        return answer;
      }
      constructor(title: string) {
        window.notified.push(title);
      }
    }
    window.Notification = Notified as unknown as typeof Notification;
  }, answer);
}

function leave(page: Page, isAway: boolean): Promise<void> {
  return page.evaluate((away) => {
    window.isAway = away;
    document.dispatchEvent(new Event('visibilitychange'));
  }, isAway);
}

/** A tracing that was asked to tell its end, while another tab is looked at. No other test traces the sample: the server has no result of it yet. */
async function traceUnseen(page: Page, answer: NotificationPermission, sample: string): Promise<void> {
  await standInForTabAndNotifications(page, answer);
  await openEditor(page);
  const asked = page.getByRole('button', { name: 'Will notify you' });
  await page.route('**/api/jobs/*/events', async (route) => {
    await expect(asked).toBeDisabled(); // however quick the machine is, the tracing does not end before
    await route.continue();
  });
  await page.getByRole('region', { name: 'Samples' }).getByRole('button', { name: sample }).click();
  await page.getByRole('button', { name: 'Notify me' }).click();
  await expect(asked).toBeDisabled();
  await leave(page, true);
  await tracingDone(page);
  await expect(page).toHaveTitle(/^done, \d+ paths/);
}

test('the end of a tracing is told in the title, by a sound and by the notification that was asked for', async ({ page }) => {
  await traceUnseen(page, 'granted', 'Ada Lovelace');
  expect(await page.evaluate(() => window.notified)).toEqual([expect.stringMatching(/: done, \d+ paths$/)]);
  expect(await page.evaluate(() => window.notes)).toBe(2);
  await leave(page, false);
  await expect(page).toHaveTitle('VectorTalker');
});

test('where the browser lets no notification through, the sound is there', async ({ page }) => {
  await traceUnseen(page, 'denied', 'Mona Lisa');
  expect(await page.evaluate(() => [window.notified.length, window.notes])).toEqual([0, 2]);
});
