/** A pen's pressure is how far its drag reaches. */
import { expect, type Page, test } from '@playwright/test';
import { centreOf, landmark, type Point, settled } from './editor';
import { openPortraitOfNumbers } from './portrait';

const GRABBED = 'Chin';
const NEIGHBOUR = 'Jaw 8';

/** Drags down by 20 pixels with a pen pressed by `force`, 0 to 1, and gives how far the neighbour came along. */
async function neighbourDrag(page: Page, force: number): Promise<number> {
  const pen = await page.context().newCDPSession(page);
  const from = await centreOf(landmark(page, GRABBED));
  const before = await centreOf(landmark(page, NEIGHBOUR));
  const send = (type: 'mouseMoved' | 'mousePressed' | 'mouseReleased', { x, y }: Point) =>
    pen.send('Input.dispatchMouseEvent', { type, x, y, force, pointerType: 'pen', button: 'left', buttons: 1, clickCount: 1 });
  await send('mousePressed', from);
  await send('mouseMoved', { x: from.x, y: from.y + 10 });
  await send('mouseMoved', { x: from.x, y: from.y + 20 });
  await send('mouseReleased', { x: from.x, y: from.y + 20 });
  await settled(page);
  const moved = (await centreOf(landmark(page, NEIGHBOUR))).y - before.y;
  await page.getByRole('button', { name: 'Reset the whole pose' }).click();
  await settled(page);
  return moved;
}

test('a hard press takes more of the face along than a light one', async ({ page }) => {
  await openPortraitOfNumbers(page);
  await settled(page);
  const light = await neighbourDrag(page, 0.1);
  const hard = await neighbourDrag(page, 1);
  expect(hard).toBeGreaterThan(light + 3);
});
