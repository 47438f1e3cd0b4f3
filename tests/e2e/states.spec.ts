/** States that are no success and no crash: no face, a file that is no picture, a server that is gone. */
import { deflateSync } from 'node:zlib';
import { expect, test } from '@playwright/test';
import { chooseFile, landmark, openEditor, tracingDone } from './editor';

test('without a face, five pins make one', async ({ page }) => {
  await openEditor(page);
  await chooseFile(page, { name: 'plain.png', mimeType: 'image/png', buffer: gradientPng(160) });
  await expect(page.getByRole('region', { name: 'Five pins' })).toContainText('No face found.');
  const nose = page.getByRole('button', { name: /^Nose tip pin/ });
  const before = await nose.getAttribute('aria-label');
  await nose.focus();
  await page.keyboard.press('Shift+ArrowDown');
  expect(await nose.getAttribute('aria-label')).not.toBe(before);
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

/** A square RGB picture of a smooth gradient, without a face. */
function gradientPng(side: number): Buffer {
  const rows = Array.from({ length: side }, (_, y) => [
    0,
    ...Array.from({ length: side }, (_, x) => [x, y, 128].map((value) => Math.round((value * 255) / side) & 255)).flat(),
  ]);
  const header = Buffer.alloc(13);
  header.writeUInt32BE(side, 0);
  header.writeUInt32BE(side, 4);
  header.set([8, 2, 0, 0, 0], 8); // 8 bits, RGB
  return Buffer.concat([
    Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'),
    chunk('IHDR', header),
    chunk('IDAT', deflateSync(Buffer.from(rows.flat()))),
    chunk('IEND', Buffer.alloc(0)),
  ]);
}

function chunk(type: string, data: Buffer): Buffer {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const sizes = Buffer.alloc(8);
  sizes.writeUInt32BE(data.length, 0);
  sizes.writeUInt32BE(crc32(body), 4);
  return Buffer.concat([sizes.subarray(0, 4), body, sizes.subarray(4)]);
}

/** CRC-32 of PNG chunks (ISO 3309), bit by bit. */
function crc32(bytes: Buffer): number {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit += 1) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return (crc ^ 0xffffffff) >>> 0;
}
