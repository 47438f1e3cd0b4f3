/** States that are no success and no crash: no face, a file that is no picture, a server that is gone. */
import { expect, test } from '@playwright/test';
import { chooseFile, landmark, openEditor, tracingDone } from './editor';
import { gradientPng } from './plainPicture';

test('without a face, five pins make one', async ({ page }) => {
  await openEditor(page);
  await chooseFile(page, { name: 'plain.png', mimeType: 'image/png', buffer: gradientPng(160) });
  await expect(page.getByRole('region', { name: 'Five pins' })).toContainText('No face found.');
  const nose = page.getByRole('button', { name: /^Nose tip pin/ });
  const before = await nose.getAttribute('aria-label');
  await nose.focus();
  await page.keyboard.press('Shift+ArrowDown');
  await expect(nose).not.toHaveAttribute('aria-label', before ?? '');
  await page.getByRole('button', { name: 'Use these pins' }).click();
  await tracingDone(page);
  await expect(landmark(page, 'Nose tip')).toBeAttached();
  await page.getByRole('button', { name: 'Surprised' }).click();
  await expect(page.getByRole('spinbutton', { name: 'Jaw, value' })).toHaveValue('0.60');
});

test('a file that is no picture is refused in one sentence', async ({ page }) => {
  await openEditor(page);
  await chooseFile(page, { name: 'notes.png', mimeType: 'image/png', buffer: Buffer.from('not a picture') });
  await expect(page.getByRole('alert')).toContainText('notes.png');
  await expect(page.getByRole('button', { name: 'Choose a file' })).toBeVisible();
});

test('without the server, new portraits wait and say so', async ({ page, context }) => {
  await openEditor(page);
  await context.setOffline(true);
  await chooseFile(page, { name: 'plain.png', mimeType: 'image/png', buffer: gradientPng(64) });
  await expect(page.getByRole('alert')).toContainText('The server does not answer');
  await context.setOffline(false);
});

test('a portrait is deleted here and on the server, after a question', async ({ page, request }) => {
  await openEditor(page);
  const posted = page.waitForResponse((response) => response.url().endsWith('/api/portraits') && response.request().method() === 'POST');
  await chooseFile(page, { name: 'plain.png', mimeType: 'image/png', buffer: gradientPng(96) });
  const { id } = (await (await posted).json()) as { id: string };
  await expect(page.getByRole('region', { name: 'Five pins' })).toBeVisible();
  await page.getByRole('button', { name: 'Delete this portrait' }).click();
  await page.getByRole('status').getByRole('button', { name: 'Delete' }).click();
  await expect(page.getByRole('button', { name: 'Choose a file' })).toBeVisible();
  await expect.poll(async () => (await request.get(`/api/portraits/${id}/image`)).status()).toBe(404);
  await page.reload();
  await expect(page.getByRole('button', { name: 'Choose a file' })).toBeVisible();
});
