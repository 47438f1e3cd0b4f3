/** Every state can be used by keyboard and screen reader: axe finds nothing, and landmarks move by arrow keys. */
import { expect, test } from '@playwright/test';
import { expectNoViolations } from './axe';
import { centreOf, drag, landmark, openEditor, traceSample } from './editor';

const WINDOWS = [
  ['1440 × 900 at 200 %', 720, 450],
  ['a phone', 390, 800],
] as const;

test('axe finds nothing, and landmarks are moved by keyboard', async ({ page }) => {
  await openEditor(page);
  await test.step('first screen', () => expectNoViolations(page));
  await traceSample(page);
  await test.step('posing', () => expectNoViolations(page));

  await test.step('keyboard', async () => {
    const jaw = landmark(page, 'Jaw 1');
    await jaw.focus();
    await page.keyboard.press('Shift+ArrowDown');
    await expect(jaw).toHaveAttribute('aria-valuetext', /Jaw 1: .* 5 down/);
    await page.keyboard.press('PageDown');
    await expect(landmark(page, 'Jaw 2')).toBeFocused();
    await page.keyboard.press('Tab');
    await expect(landmark(page, 'Left brow 1')).toBeFocused();
    await page.keyboard.press('Control+z');
    await expect(page.getByRole('button', { name: 'Undo' })).toBeDisabled();
  });

  await test.step('correcting the landmarks', async () => {
    await page.getByRole('button', { name: 'Adjust the landmarks' }).click();
    await expect(page.getByRole('img', { name: 'Mouth, enlarged' })).toBeVisible();
    await expectNoViolations(page);
    const corner = await centreOf(page.getByRole('img', { name: 'Mouth, enlarged' }).locator('circle').first());
    await drag(page, corner, { x: corner.x - 12, y: corner.y });
    await expect(page.getByRole('button', { name: 'Undo' })).toBeEnabled(); // the drag is one step
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect(page.getByRole('button', { name: 'Undo' })).toBeDisabled();
  });
  await page.getByRole('tab', { name: 'Layers' }).click();
  await page.keyboard.press('?');
  await expect(page.getByRole('dialog', { name: 'Keyboard shortcuts' })).toBeVisible();
  await test.step('layers and shortcuts', () => expectNoViolations(page));
  await page.keyboard.press('Escape');

  for (const [name, width, height] of WINDOWS)
    await test.step(name, async () => {
      await page.setViewportSize({ width, height });
      await expect(page.getByRole('button', { name: 'Save' })).toBeInViewport();
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(width);
      await expectNoViolations(page);
    });
  await page.getByRole('button', { name: 'Hide the panel' }).click();
  await expect(page.getByRole('tabpanel')).toBeHidden();
});
