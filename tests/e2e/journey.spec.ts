/** The main way through the editor: a sample becomes a layered SVG that is dragged, played, reloaded and exported. */
import { expect, test } from '@playwright/test';
import { centreOf, drag, landmark, openEditor, pathData, pictureShot, settled, stage, traceSample } from './editor';
import { keptWork } from './kept';
import { hasCorner, movedPoints, movedRegion, movedTriangles, standing } from './moved';
import { difference } from './pixels';

// Of 255. The browser's antialiasing of an outline depends on what else crosses the same row of pixels (19 was seen): pixels say
// only that nothing large changed elsewhere, points of the curves say that nothing moved.
const LARGE = 64;

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
    const origin = await stage(page).boundingBox();
    const before = await standing(page);
    await page.keyboard.down('Alt');
    await drag(page, from, { x: from.x, y: from.y + 20 });
    await page.keyboard.up('Alt');
    await settled(page);
    expect((await centreOf(lip)).y - from.y).toBeGreaterThan(3);
    const after = await standing(page);
    const moved = movedTriangles(before, after);
    const onStage = { x: from.x - (origin?.x ?? 0), y: from.y - (origin?.y ?? 0) };
    expect(moved.length).toBeGreaterThan(2);
    expect(moved.filter((triangle) => !hasCorner(before.triangles[triangle], onStage))).toEqual([]);
    const posedShot = await pictureShot(page);
    expect((await difference(page, restShot, posedShot)).count).toBeGreaterThan(20);
    const region = movedRegion(before, after);
    expect((await difference(page, restShot, posedShot, region)).largest).toBeLessThan(LARGE);
    const points = await movedPoints(page, rest, await pathData(page), region);
    expect(points.count).toBeGreaterThan(20);
    expect(points.outside).toEqual([]);
  });

  await test.step('one drag is one step: undo brings the rest picture back, exactly', async () => {
    const posed = await pathData(page);
    expect(posed).not.toEqual(rest);
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(() => pathData(page)).toEqual(rest);
    expect((await difference(page, restShot, await pictureShot(page))).largest).toBeLessThan(LARGE);
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
    await expect.poll(async () => (await keptWork(page))?.history.present.tracks.length).toBe(1);
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
    await expect(page.getByRole('button', { name: /^Undo: back to/ })).toBeEnabled(); // what was open gave way to it
    await expect.poll(() => pathData(page)).toEqual(posed);
  });

  await test.step('exports are offered', async () => {
    await page.getByText('Export', { exact: true }).click();
    for (const name of ['SVG', 'Animated SVG', 'MP4 video'])
      await expect(page.getByRole('button', { name: new RegExp(`^${name}`) })).toBeVisible();
  });
});
