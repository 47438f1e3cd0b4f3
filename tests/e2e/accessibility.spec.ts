/** Every state can be used by keyboard and screen reader: axe finds nothing, and landmarks move by arrow keys. */
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { expect, type Page, test } from '@playwright/test';
import { landmark, openEditor, traceSample } from './editor';

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

type Axe = { run: () => Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> };

async function violations(page: Page): Promise<string[]> {
  await page.evaluate(AXE);
  return page.evaluate(async () => {
    const { violations: found } = await (window as unknown as { axe: Axe }).axe.run();
    return found.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html.slice(0, 160)}`));
  });
}

const SCHEMES = ['light', 'dark'] as const;

/** axe in both colour schemes. */
async function expectNoViolations(page: Page): Promise<void> {
  for (const colorScheme of SCHEMES) {
    await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
    expect(await violations(page), colorScheme).toEqual([]);
  }
}

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
