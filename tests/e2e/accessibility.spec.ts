/** Every state can be used by keyboard and screen reader: axe finds nothing, and landmarks move by arrow keys. */
import { expect, test } from '@playwright/test';
import { expectNoViolations } from './axe';
import { landmark, openEditor, traceSample } from './editor';

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

  await page.getByRole('tab', { name: 'Layers' }).click();
  await page.keyboard.press('?');
  await expect(page.getByRole('dialog', { name: 'Keyboard shortcuts' })).toBeVisible();
  await test.step('layers and shortcuts', () => expectNoViolations(page));
});
