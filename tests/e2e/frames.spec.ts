/** What a frame writes into the picture: no more than moves, and at the end exactly the pose. */
import { expect, type Page, test } from '@playwright/test';
import { settled } from './editor';
import { openPortraitOfNumbers } from './portrait';

test.beforeEach(async ({ page }) => {
  await openPortraitOfNumbers(page);
  await settled(page);
});

test('a pose reached in small steps is the pose set at once', async ({ page }) => {
  await slideJaw(page, [0.01, 0.02, 0.03, 0.04, 0.4, 0.41, 0.42]);
  const slid = await pictureAttributes(page);
  await page.getByRole('button', { name: 'Reset the whole pose' }).click();
  await page.getByRole('spinbutton', { name: 'Jaw, value' }).fill('0.42');
  await page.getByRole('spinbutton', { name: 'Jaw, value' }).blur();
  await settled(page);
  expect(await pictureAttributes(page)).toEqual(slid);
});

test('a mouth pose writes no path of the scenery and none twice', async ({ page }) => {
  const rest = await pictureAttributes(page);
  await page.evaluate(() => {
    const written: string[] = [];
    Reflect.set(window, 'written', written);
    const observer = new MutationObserver((records) => {
      for (const { target } of records)
        if (target instanceof SVGPathElement) written.push(target.closest('#back, #fore, #local')?.id ?? 'opening');
    });
    for (const group of document.querySelectorAll('#back, #fore, #local'))
      observer.observe(group, { attributes: true, attributeFilter: ['d'], subtree: true });
  });
  await slideJaw(page, [0.5]);
  const posed = await pictureAttributes(page);
  const written = await page.evaluate(() => Reflect.get(window, 'written') as string[]);
  expect(written).not.toContain('back');
  const moved = posed.filter(({ tag, d }, index) => tag === 'path' && d !== rest[index].d);
  expect(written.length).toBe(moved.length);
  expect(moved.length).toBeGreaterThan(0);
});

/** As a drag of the slider does it: values one frame after another, and a change at its end. */
async function slideJaw(page: Page, values: readonly number[]): Promise<void> {
  await page.getByRole('slider', { name: /^Jaw: / }).evaluate(async (slider, steps) => {
    for (const value of steps) {
      (slider as HTMLInputElement).value = `${value}`;
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      await new Promise(requestAnimationFrame);
      await new Promise(requestAnimationFrame);
    }
    slider.dispatchEvent(new Event('change', { bubbles: true }));
  }, values);
  await settled(page);
}

function pictureAttributes(page: Page): Promise<{ tag: string; d: string | null; gradientTransform: string | null }[]> {
  return page.evaluate(() =>
    Array.from(document.querySelectorAll('#back path, #fore path, #local path, .picture linearGradient'), (element) => ({
      tag: element.localName,
      d: element.getAttribute('d'),
      gradientTransform: element.getAttribute('gradientTransform'),
    })),
  );
}
