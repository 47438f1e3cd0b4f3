/** The main way through the editor: a sample becomes a layered SVG that is dragged, played, reloaded and exported. */
import { expect, type Page, test } from '@playwright/test';
import { centreOf, drag, landmark, openEditor, type Point, pathData, pictureShot, settled, stage, traceSample } from './editor';
import { difference } from './pixels';

test('a sample becomes a layered SVG, is posed, played, reloaded and exported', async ({ page }) => {
  await openEditor(page);
  await test.step('trace', async () => {
    await traceSample(page);
    for (const layer of ['back', 'fore', 'local']) await expect(page.locator(`svg g#${layer}`)).toHaveCount(1);
    expect((await pathData(page)).length).toBeGreaterThan(50);
  });
  const rest = await pathData(page);
  const restShot = await pictureShot(page);

  await test.step('drag a landmark of the mouth, alone: nothing outside its triangles moves', async () => {
    const lip = landmark(page, 'Lower lip, middle');
    const from = await centreOf(lip);
    const before = await trianglesAround(page, from);
    await page.keyboard.down('Alt');
    await drag(page, from, { x: from.x, y: from.y + 12 });
    await page.keyboard.up('Alt');
    await settled(page);
    const to = await centreOf(lip);
    expect(to.y - from.y).toBeGreaterThan(3);
    const after = await trianglesAround(page, to);
    const moved = await difference(page, restShot, await pictureShot(page));
    const origin = await stage(page).boundingBox();
    const border = 2; // antialiasing
    expect(moved.count).toBeGreaterThan(20);
    expect(moved.left + (origin?.x ?? 0)).toBeGreaterThan(Math.min(before.left, after.left) - border);
    expect(moved.right + (origin?.x ?? 0)).toBeLessThan(Math.max(before.right, after.right) + border);
    expect(moved.top + (origin?.y ?? 0)).toBeGreaterThan(Math.min(before.top, after.top) - border);
    expect(moved.bottom + (origin?.y ?? 0)).toBeLessThan(Math.max(before.bottom, after.bottom) + border);
  });

  await test.step('one drag is one step: undo brings the rest picture back, exactly', async () => {
    const posed = await pathData(page);
    expect(posed).not.toEqual(rest);
    await page.getByRole('button', { name: 'Undo' }).click();
    expect((await difference(page, restShot, await pictureShot(page))).count).toBe(0);
    await expect(page.getByRole('button', { name: 'Undo' })).toBeDisabled();
    await page.getByRole('button', { name: 'Redo' }).click();
    await settled(page);
    expect(await pathData(page)).toEqual(posed);
  });

  await test.step('grab the mouth itself: the jaw opens', async () => {
    await page.getByRole('button', { name: 'Reset the whole pose' }).click();
    const upper = await centreOf(landmark(page, 'Upper lip, middle'));
    const lower = await centreOf(landmark(page, 'Lower lip, middle'));
    await page.keyboard.press('l'); // without handles the whole mouth is one target
    const middle = { x: (upper.x + lower.x) / 2, y: (upper.y + lower.y) / 2 };
    await drag(page, middle, { x: middle.x, y: middle.y + 25 });
    await expect.poll(async () => Number(await page.getByRole('spinbutton', { name: 'Jaw, value' }).inputValue())).toBeGreaterThan(0.1);
    await page.keyboard.press('l');
    await page.getByRole('button', { name: 'Smile', exact: true }).click();
  });

  await test.step('the demo plays, and scrubbing goes back to a frame exactly', async () => {
    await page.getByRole('button', { name: 'Play the demo' }).click();
    await expect(page.getByRole('button', { name: 'Pause' })).toBeVisible();
    const first = await pictureShot(page);
    await expect.poll(async () => (await difference(page, first, await pictureShot(page))).count).toBeGreaterThan(50);
    await page.getByRole('button', { name: 'Pause' }).click();
    const playhead = page.getByRole('slider', { name: 'Playhead' });
    await playhead.fill('4.92');
    await settled(page);
    const open = await pathData(page);
    await playhead.fill('0.6');
    await settled(page);
    expect(await pathData(page)).not.toEqual(open);
    await playhead.fill('4.92');
    await settled(page);
    expect(await pathData(page)).toEqual(open);
    await page.getByRole('button', { name: 'Back to the start' }).click();
  });

  await test.step('a reload loses nothing, undo included', async () => {
    const posed = await pathData(page);
    await page.waitForTimeout(600); // a reload in the middle of a drag may lose the drag
    await page.reload();
    await expect(page.getByRole('button', { name: 'Save' })).toBeEnabled();
    await expect.poll(() => pathData(page)).toEqual(posed);
    await expect(page.getByRole('combobox', { name: 'Track' })).toHaveValue(/Blink, smile, speak, tilt/);
    await page.getByRole('button', { name: 'Undo' }).click(); // the track
    await page.getByRole('button', { name: 'Undo' }).click(); // the smile
    await expect(page.getByRole('spinbutton', { name: 'Corners, value' })).toHaveValue('0.00');
  });

  await test.step('the project is saved and opens again', async () => {
    const download = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Save' }).click();
    const file = await download;
    expect(file.suggestedFilename()).toMatch(/\.vtalk$/);
    const posed = await pathData(page);
    const dialog = page.waitForEvent('filechooser');
    await page.getByRole('button', { name: 'Open', exact: true }).click();
    await (await dialog).setFiles(await file.path());
    await expect(page.getByRole('button', { name: 'Undo' })).toBeDisabled();
    await expect.poll(() => pathData(page)).toEqual(posed);
  });

  await test.step('exports are offered', async () => {
    await page.getByText('Export', { exact: true }).click();
    for (const name of ['SVG', 'Animated SVG', 'MP4 video'])
      await expect(page.getByRole('button', { name: new RegExp(`^${name}`) })).toBeVisible();
  });
});

/** The box round the mesh triangles that meet at a point of the page, and round their neighbours, whose curves join on smoothly. */
async function trianglesAround(page: Page, at: Point): Promise<{ left: number; top: number; right: number; bottom: number }> {
  await page.getByRole('button', { name: 'Mesh' }).click();
  await settled(page);
  const d = (await page.locator('.overlay .mesh').getAttribute('d')) ?? '';
  await page.getByRole('button', { name: 'Mesh' }).click();
  const origin = await stage(page).boundingBox();
  const triangles = d
    .split('Z')
    .filter(Boolean)
    .map((text) => {
      const t = (text.match(/-?[\d.]+/g) ?? []).map(Number);
      return [0, 2, 4].map((k): Point => ({ x: t[k] + (origin?.x ?? 0), y: t[k + 1] + (origin?.y ?? 0) }));
    });
  const touching = (points: readonly Point[]) =>
    triangles.filter((triangle) => triangle.some((a) => points.some((b) => Math.hypot(a.x - b.x, a.y - b.y) < 1))).flat();
  const corners = touching(touching([at]));
  expect(corners.length).toBeGreaterThan(0);
  return {
    left: Math.min(...corners.map(({ x }) => x)),
    top: Math.min(...corners.map(({ y }) => y)),
    right: Math.max(...corners.map(({ x }) => x)),
    bottom: Math.max(...corners.map(({ y }) => y)),
  };
}
