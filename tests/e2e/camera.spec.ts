/** The camera takes a portrait, and says in one sentence why it cannot. */
import { type BrowserContext, chromium, expect, type Page, test } from '@playwright/test';
import { expectNoViolations } from './axe';
import { systemChromium } from './chromium.mjs';

const browser = systemChromium();
const withDevice = (device: string) => ({ ...browser, args: [...(browser.args ?? []), device] });

test.use({ launchOptions: withDevice('--use-fake-device-for-media-stream') });

const useCamera = (page: Page) => page.getByRole('button', { name: 'Use the camera' });

/** Whatever is granted, all else is refused. */
function allow(context: BrowserContext, permission: 'camera' | 'geolocation'): Promise<void> {
  return context.grantPermissions([permission]);
}

test('a still of the camera becomes the portrait', async ({ page, context }) => {
  await allow(context, 'camera');
  await page.goto('/');
  await useCamera(page).click();
  const seen = page.getByLabel('What the camera sees');
  await expect(page.getByRole('button', { name: 'Take the picture' })).toBeEnabled();
  await expectNoViolations(page);
  const stream = await seen.evaluateHandle((video: HTMLVideoElement) => video.srcObject as MediaStream);
  await page.getByRole('button', { name: 'Take the picture' }).click();
  await expect(page.getByRole('textbox', { name: 'Name of the portrait' })).toHaveValue('Camera picture');
  await expect(page.getByRole('region', { name: 'Five pins' })).toBeVisible(); // a pattern, not a face
  expect(await stream.evaluate((tracks) => tracks.getTracks().map(({ readyState }) => readyState))).toEqual(['ended']);
});

test('Cancel turns the camera off', async ({ page, context }) => {
  await allow(context, 'camera');
  await page.goto('/');
  await useCamera(page).click();
  await expect(page.getByRole('button', { name: 'Take the picture' })).toBeEnabled();
  const stream = await page.getByLabel('What the camera sees').evaluateHandle((video: HTMLVideoElement) => video.srcObject as MediaStream);
  await page.getByRole('button', { name: 'Cancel' }).click();
  await expect(useCamera(page)).toBeVisible();
  expect(await stream.evaluate((tracks) => tracks.getTracks().map(({ readyState }) => readyState))).toEqual(['ended']);
});

test('a camera that is not allowed is told in one sentence, and other ways stay open', async ({ page, context }) => {
  await allow(context, 'geolocation');
  await page.goto('/');
  await useCamera(page).click();
  await expect(page.getByRole('alert')).toHaveText(/The browser may not use the camera\. Allow it/);
  await expect(page.getByRole('button', { name: 'Choose a file' })).toBeVisible();
  await expectNoViolations(page);
});

test('a device without a camera is told so', async ({ baseURL }) => {
  const without = await chromium.launch(withDevice('--use-fake-device-for-media-stream=device-count=0'));
  const context = await without.newContext({ baseURL });
  await allow(context, 'camera');
  const page = await context.newPage();
  await page.goto('/');
  await useCamera(page).click();
  await expect(page.getByRole('alert')).toHaveText(/No camera was found/);
  await without.close();
});
