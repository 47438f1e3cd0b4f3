/** What a user does in the editor, in the user's words. */
import { expect, type Locator, type Page } from '@playwright/test';

/** The first job waits for its worker to load; on a busy machine that takes longer than the tracing. */
const TRACING_MILLISECONDS = 200_000;

export type Point = { readonly x: number; readonly y: number };

/** The first screen, with the quickest detail chosen. */
export async function openEditor(page: Page): Promise<void> {
  await page.goto('/');
  await page.getByRole('radio', { name: 'Draft' }).check();
}

/** The first sample of the first screen becomes a layered SVG. */
export async function traceSample(page: Page): Promise<void> {
  await page.getByRole('region', { name: 'Samples' }).getByRole('button').first().click();
  await tracingDone(page);
}

/** The first coarse picture is good enough for tests, and the quickest; a quick machine may be done before it is kept. */
export async function tracingDone(page: Page): Promise<void> {
  const enough = page.getByRole('button', { name: 'Good enough' });
  await expect(page.locator('#fore')).toBeAttached({ timeout: TRACING_MILLISECONDS });
  await expect(async () => {
    if (await enough.isVisible()) await enough.click({ timeout: 1000 });
    await expect(page.getByRole('region', { name: 'Progress' })).toBeHidden({ timeout: 2000 });
  }).toPass({ timeout: TRACING_MILLISECONDS });
  await expect(page.getByRole('button', { name: 'Save' })).toBeEnabled();
}

/** Gives a picture to the file dialog. */
export async function chooseFile(page: Page, file: { name: string; mimeType: string; buffer: Buffer }): Promise<void> {
  const dialog = page.waitForEvent('filechooser');
  await page.getByRole('button', { name: 'Choose a file' }).click();
  await (await dialog).setFiles(file);
}

export const stage = (page: Page): Locator => page.getByRole('main', { name: 'Stage' });
export const landmark = (page: Page, name: string): Locator => page.getByRole('slider', { name, exact: true });

export async function centreOf(locator: Locator): Promise<Point> {
  const box = await locator.boundingBox();
  if (!box) throw new Error('not on the page');
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

export async function drag(page: Page, from: Point, to: Point): Promise<void> {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2);
  await page.mouse.move(to.x, to.y);
  await page.mouse.up();
}

/**
 * The bare picture, without points, options and messages. It is painted as a whole: where the browser paints only what
 * changed, its antialiasing depends on what that was.
 */
export async function pictureShot(page: Page): Promise<Buffer> {
  await showAbovePicture(page, 'hidden');
  await displayPicture(page, 'none');
  await settled(page);
  await displayPicture(page, '');
  await settled(page);
  const shot = await stage(page).screenshot({ animations: 'disabled' });
  await showAbovePicture(page, '');
  return shot;
}

/** By the style object: the page's policy forbids style sheets from elsewhere. */
function showAbovePicture(page: Page, visibility: 'hidden' | ''): Promise<void> {
  return page.evaluate((value) => {
    for (const element of document.querySelectorAll<HTMLElement>('.overlay, .insets, .stage-options, .hint, .stage-messages'))
      element.style.visibility = value;
  }, visibility);
}

function displayPicture(page: Page, display: 'none' | ''): Promise<void> {
  return page.evaluate((value) => {
    for (const picture of document.querySelectorAll<SVGSVGElement>('.picture')) picture.style.display = value;
  }, display);
}

/** Two frames later: what was asked for is painted. */
export async function settled(page: Page): Promise<void> {
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
}

/** `d` of every path of the picture, in painter's order. */
export function pathData(page: Page): Promise<string[]> {
  return page.evaluate(() =>
    Array.from(document.querySelectorAll('#back path, #fore path, #local path'), (path) => path.getAttribute('d') ?? ''),
  );
}
