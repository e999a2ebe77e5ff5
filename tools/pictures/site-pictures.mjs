/**
 * Draws the pictures of web/public/site from the icon and the built app's demo: icons of the installed page, and the
 * picture that messengers show beside a link to it.
 *
 *     npx vite build && node tools/pictures/site-pictures.mjs
 */
import { readFileSync, statSync } from 'node:fs';
import path from 'node:path';
import { root } from '../run.mjs';
import { withBuiltApp } from './built-app.mjs';

const FOLDER = path.join(root, 'web/public/site');
const DARK = '#16191d';
/** Edge in pixels, share of it that the sign takes, and background. Systems cut a maskable one to a shape of their own. */
const ICONS = {
  'icon-192.png': { edge: 192, sign: 1, background: 'transparent' },
  'icon-512.png': { edge: 512, sign: 1, background: 'transparent' },
  'icon-maskable-512.png': { edge: 512, sign: 0.6, background: DARK },
  'icon-touch-180.png': { edge: 180, sign: 0.7, background: DARK },
};
/** Pixels of the picture of a link. */
const LINK = { width: 1200, height: 630 };
const FONT = 'node_modules/@fontsource-variable/hanken-grotesk/files/hanken-grotesk-latin-wght-normal.woff2';
const WAIT_MS = 300_000;

/**
 * @param {import('@playwright/test').Browser} browser
 * @param {string} name
 * @param {{ edge: number, sign: number, background: string }} icon
 */
async function drawIcon(browser, name, { edge, sign, background }) {
  const page = await browser.newPage({ viewport: { width: edge, height: edge } });
  const svg = readFileSync(path.join(root, 'web/public/icon.svg'), 'utf8');
  await page.setContent(`<body style="margin:0; display:grid; place-items:center; height:100vh; background:${background}">
    ${svg.replace('<svg ', `<svg width="${sign * edge}" height="${sign * edge}" `)}`);
  await page.screenshot({ path: path.join(FOLDER, name), omitBackground: true });
  await page.close();
}

/**
 * @param {import('@playwright/test').Browser} browser
 * @param {string} address of the built app
 */
async function drawLink(browser, address) {
  const app = await browser.newPage({ colorScheme: 'dark', serviceWorkers: 'block' });
  app.setDefaultTimeout(WAIT_MS);
  await app.goto(address);
  await app.getByRole('button', { name: 'Download', exact: true }).click();
  await app.getByRole('radio', { name: '1080p' }).click();
  const coming = app.waitForEvent('download');
  await app.getByRole('button', { name: 'Save picture' }).click();
  const dance = readFileSync(await (await coming).path(), 'base64');
  await app.close();

  const page = await browser.newPage({ viewport: LINK });
  const font = readFileSync(path.join(root, FONT), 'base64');
  await page.setContent(`<style>
      @font-face { font-family: Hanken; src: url(data:font/woff2;base64,${font}); font-weight: 100 900 }
      body { margin: 0; background: url(data:image/png;base64,${dance}) 0 50% / auto 116%; color: #eef1f4; font-family: Hanken }
      h1 { margin: 210px 0 0 64px; font-size: 76px; font-weight: 650; letter-spacing: -2px }
      p { margin: 12px 64px; font-size: 31px; line-height: 42px }
    </style><h1>ReactDance</h1><p>Drop a video of a dancer.<br>Watch the partner answer.</p>`);
  await page.evaluate('document.fonts.ready');
  const file = path.join(FOLDER, 'link.jpg');
  await page.screenshot({ path: file, type: 'jpeg', quality: 82 });
  console.log(`link.jpg: ${Math.round(statSync(file).size / 1000)} kB`);
}

await withBuiltApp(async (browser, address) => {
  for (const [name, icon] of Object.entries(ICONS)) await drawIcon(browser, name, icon);
  await drawLink(browser, address);
});
