import { bvh, wav } from './support/files';
import { App, maxDistance, meanDistance, SHIPPED } from './support/app-page';
import { expect, test } from './support/fixtures';

test('guidance by body part, presets and reset', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const coarse = page.getByRole('slider', { name: 'Coarse guidance' });
  const upper = page.getByRole('slider', { name: 'Upper body, coarse' });
  const lower = page.getByRole('slider', { name: 'Lower body, coarse' });
  const preset = page.getByRole('combobox', { name: 'Guidance preset' });
  const fold = page.getByRole('button', { name: /By body part/ });
  await preset.selectOption({ index: 0 });

  await expect(upper).toBeHidden();
  await fold.click();
  await expect(fold).toContainText('Same for all');
  await upper.fill('0.3');
  await expect(fold).toContainText('Mixed');
  await expect(coarse).toHaveAttribute('aria-valuetext', /0\.10.*mixed/);
  await expect(preset.locator('option:checked')).toHaveText('Custom');

  // The big fader moves the parts together; the small ones have its keys.
  await coarse.fill('0.4');
  await expect(upper).toHaveValue('0.6');
  await expect(lower).toHaveValue('0.3');
  await lower.focus();
  await page.keyboard.press('ArrowRight');
  await expect(lower).toHaveValue('0.35');
  await upper.dblclick();
  await expect(upper).toHaveValue('0');

  await preset.selectOption({ label: 'Sharp' });
  await expect(lower).toHaveValue('0');
  await expect(page.getByRole('slider', { name: 'Lower body, fine' })).toHaveValue('0.8');
  await expect(preset.locator('option:checked')).toHaveText('Sharp');
  await expect(preset).toHaveAttribute('title', 'More quick movement, strong accents.');
  await expect(fold).toContainText('Same for all');
  await page.getByRole('button', { name: 'Reset guidance' }).click();
  await expect(preset.locator('option:checked')).toHaveText('Balanced');
});

test('a fader is moved by the main button alone, and a double click is one step of undo', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const coarse = page.getByRole('slider', { name: 'Coarse guidance' });
  await coarse.fill('0.5');
  await app.settled();
  const { x, y, width, height } = (await coarse.boundingBox())!;
  const at = (share: number) => page.mouse.move(x + share * width, y + height / 2);

  await at(0.3);
  await page.keyboard.down('Shift');
  await page.mouse.down({ button: 'right' });
  expect(await app.read(({ drag }) => drag)).toBeNull();
  await at(0.9);
  await page.mouse.up({ button: 'right' });
  await page.keyboard.up('Shift');
  await expect(coarse).toHaveValue('0.5');

  // The first click moves it, unless it is on the handle.
  const { value, share } = await coarse.evaluate((input: HTMLInputElement) => ({
    value: input.value,
    share: (input.valueAsNumber - Number(input.min)) / (Number(input.max) - Number(input.min)),
  }));
  for (const place of [0.3, share]) {
    await page.mouse.dblclick(x + place * width, y + height / 2);
    await expect(coarse).toHaveValue('0');
    await page.keyboard.press('Control+z');
    await expect(coarse).toHaveValue(value);
  }
});

test('the music has its own guidance, which is disabled without a song', async ({ page }) => {
  await page.route('**/demo/demo.json', (route) => route.fulfill({ status: 404 }));
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  const music = page.getByRole('slider', { name: 'Music guidance' });
  await app.drop(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  await expect(music).toBeDisabled();

  await app.drop(wav({ seconds: 3 }));
  await expect(music).toBeEnabled();
  const made = (value: number) =>
    app.until(
      ({ reaction, job }, m) => !job && reaction?.inputs.song && reaction.inputs.settings.music === m,
      value,
    );
  await made(1);
  const before = await app.reactor();
  await page.keyboard.press('m');
  await expect(music).toBeFocused();
  await page.keyboard.press('End');
  await made(10);
  expect(maxDistance(before, await app.reactor())).toBeGreaterThan(1e-3);
  await expect(music).toHaveAttribute('aria-valuetext', '10.00, more song');

  const preset = page.getByRole('combobox', { name: 'Guidance preset' });
  await preset.selectOption({ label: 'Less song' });
  await made(0);
  await preset.selectOption({ index: 0 });
  await made(1);
  expect(maxDistance(before, await app.reactor())).toBeLessThan(1e-6);
  await music.dblclick();
  await expect(music).toHaveValue('1');
});

test('the variety is how far a seed is from the mean of several', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.chooseLeader(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  const variety = page.getByRole('slider', { name: 'Variety' });
  const seed = page.getByRole('spinbutton', { name: 'Seed' });
  // Seeds also differ in the fine layer, and in what the song changes.
  await page.getByRole('slider', { name: 'Fine guidance' }).press('Home');
  await page.getByRole('slider', { name: 'Music guidance' }).press('Home');
  const dances: Record<number, number[]> = {};
  for (const one of [5, 6]) {
    await seed.fill(String(one));
    await seed.press('Enter');
    for (const key of ['Home', 'End']) {
      await variety.press(key);
      await app.until(({ job, reaction, settings }) => !job && reaction?.inputs.settings === settings);
      dances[one * 10 + Number(await variety.inputValue())] = await app.reactor();
    }
  }
  await expect(variety).toHaveAttribute('aria-valuetext', '2.00, individual');
  const [average, individual] = [
    meanDistance(dances[50]!, dances[60]!),
    meanDistance(dances[52]!, dances[62]!),
  ];
  expect(individual).toBeGreaterThan(10 * average);
  await variety.dblclick();
  await expect(variety).toHaveValue('1');
  await page.keyboard.press('c');
  await page.keyboard.press('y');
  await expect(variety).toBeFocused();
});

test('the seed is chosen at random, locked and kept, and swapped roles are named everywhere', async ({
  page,
}) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.chooseLeader(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  const again = page.getByRole('button', { name: 'Generate again' });
  const dice = page.getByRole('button', { name: 'New random seed' });
  const lock = page.getByRole('button', { name: 'Lock the seed' });
  const made = () => app.read(({ reaction }) => reaction?.inputs.settings.seed ?? null);
  const done = () =>
    app.until(({ job, reaction, settings }) => !job && reaction?.inputs.settings === settings);

  const first = await made();
  const seed = page.getByRole('spinbutton', { name: 'Seed' });
  await seed.fill('77');
  await page.keyboard.press('Enter');
  await done();
  expect(await made()).toBe(77);
  // What is being typed is undone letter by letter; what has been typed, with the dance that it made.
  await page.keyboard.type('8');
  await page.keyboard.press('Control+z');
  expect(await app.read(({ settings }) => settings?.seed)).toBe(77);
  await expect(seed).toHaveValue('77');
  await page.keyboard.press('Control+z');
  expect(await made()).toBe(first);
  await expect(seed).toHaveValue(String(first));

  await again.click();
  await app.until(({ reaction }, seed) => reaction && reaction.inputs.settings.seed !== seed, first);
  await done();
  const second = await made();
  await lock.click();
  await expect(lock).toHaveAttribute('aria-pressed', 'true');
  await expect(dice).toBeDisabled();
  await page.keyboard.press('d');
  const before = await app.read(({ reaction }) => reaction?.motion.positions[0]);
  await again.click();
  await done();
  expect(await made()).toBe(second);
  expect(await app.read(({ reaction }) => reaction?.motion.positions[0])).toBe(before);

  const reactor = await app.reactor();
  await page.getByRole('button', { name: 'Swap roles' }).click();
  await app.until(({ job, reaction }) => !job && reaction?.inputs.settings.role === 'leader');
  expect(maxDistance(reactor, await app.reactor())).toBeGreaterThan(1e-3);
  await expect(page.getByRole('button', { name: /^Reactor: mine\.bvh/ })).toBeVisible();
  // The letter of the take on the stage has the colour of the dancer that it made.
  const letter = page.getByRole('button', { name: /^Use .* as A$/, pressed: true });
  const leader = await page
    .getByRole('listitem')
    .filter({ hasText: 'Leader' })
    .evaluate((item) => getComputedStyle(item).color);
  await expect(letter).toHaveCSS('background-color', leader);
  await page.getByRole('button', { name: 'Download', exact: true }).click();
  const menu = page.getByRole('dialog', { name: 'Download' });
  await expect(menu.getByRole('radio', { name: 'Leader' })).toBeChecked();
  await expect(menu).toContainText(/_leader\.bvh/);
});

test('a height that is being typed outlasts a reaction that comes meanwhile', async ({ page }) => {
  const app = new App(page);
  await app.openWithoutPicture();
  await app.settled();
  await app.chooseLeader(bvh({ frames: 90, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  const height = page.getByRole('spinbutton', { name: 'Height of the reactor in centimetres' });
  const label = await height.getAttribute('aria-label');
  const earlier = await app.read(({ takes }) => takes.length);
  // In one task of the page, so that the reaction comes after what is typed.
  await page.evaluate(`
    [...document.querySelectorAll('button')].find((one) => one.textContent === 'Generate again').click();
    const height = document.querySelector('[aria-label="${label}"]');
    height.focus();
    height.select();
    document.execCommand('insertText', false, '15');
  `);
  await app.until(({ takes, job }, count) => takes.length > count && !job, earlier);
  await expect(height).toHaveValue('15');
  await page.keyboard.type('5');
  await page.keyboard.press('Enter');
  expect(await app.read(({ settings }) => settings?.height)).toBe(1.55);
  await height.fill('999');
  await page.keyboard.press('Enter');
  const highest = await height.getAttribute('max');
  await expect(height, 'the nearest that can be asked for').toHaveValue(highest ?? '');
});

test('three reactions that differ most are made, to pick from', async ({ page }) => {
  const app = new App(page);
  await app.open();
  await app.settled();
  await app.chooseLeader(bvh({ frames: 900, name: 'mine.bvh' }));
  await app.reaction('mine.bvh');
  const seed = (await app.read(({ settings }) => settings?.seed)) ?? 0;
  const cards = page.getByRole('radiogroup', { name: 'Reactions to pick from' }).getByRole('radio');
  await expect(cards.first()).toBeChecked();
  await expect(cards.last()).toBeDisabled();

  const three = page.getByRole('button', { name: 'Three reactions' });
  await three.click();
  await page.keyboard.press('Escape');
  await app.until(({ variations }) => variations && !variations.making);
  await expect(cards.last()).toBeDisabled();
  // The reaction on the stage has its card again.
  await expect(cards.first()).toBeChecked();
  // The second click of a double click stops nothing.
  await three.dblclick();
  await app.until(({ variations }) => variations?.list.every(({ reaction }) => reaction));
  await expect(page.getByRole('button', { name: 'Three others' })).toBeVisible();
  await expect(cards).toHaveCount(3);
  const seeds = await app.read(({ variations }) => variations?.list.map((one) => one.seed ?? -1) ?? []);
  expect(new Set(seeds).size).toBe(3);
  for (const one of seeds) expect([0, 1, 2, 3, 4, 5]).toContain(one - seed);
  // The stage keeps its dance until one is picked.
  expect(await app.read(({ reaction }) => reaction?.inputs.settings.seed)).toBe(seed);
  const before = await app.reactor();
  await cards.nth(2).click();
  await expect(cards.nth(2)).toBeChecked();
  await app.until(({ job }) => !job);
  expect(await app.read(({ settings }) => settings?.seed)).toBe(seeds[2]);
  const third = await app.reactor();
  expect(maxDistance(before, third)).toBeGreaterThan(1e-3);
  await page.keyboard.press('ArrowRight');
  await expect(cards.first()).toBeChecked();
  expect(maxDistance(third, await app.reactor())).toBeGreaterThan(1e-3);

  // The cards show one moment, whatever the playhead does.
  const names = await cards.evaluateAll((list) => list.map((card) => card.getAttribute('aria-label') ?? ''));
  const moments = names.map((name) => /shown at (\d:\d\d\.\d)$/.exec(name)?.[1]);
  expect(moments[0]).toBeDefined();
  expect(new Set(moments).size).toBe(1);
  await expect(cards.first()).toContainText(moments[0]!);
  const pictures = () =>
    cards
      .locator('canvas')
      .evaluateAll((list) => list.map((canvas) => (canvas as HTMLCanvasElement).toDataURL()));
  await expect.poll(async () => new Set(await pictures()).size).toBe(3);
  const drawn = await pictures();
  await page.keyboard.press('End');
  await expect(cards.first()).toBeFocused();
  await page.getByRole('slider', { name: 'Playhead' }).press('End');
  await app.until(({ playback }) => playback.time > 20);
  // Time in which they would be drawn again.
  await page.evaluate('new Promise((resolve) => setTimeout(resolve, 300))');
  expect(await pictures()).toEqual(drawn);

  // Other guidance asks for other reactions.
  await page.getByRole('slider', { name: 'Coarse guidance' }).fill('0.5');
  await expect(cards.last()).toBeDisabled();
  await app.until(({ job, variations }) => !job && !variations);
});

test('a card shows all of a dancer, however tall', async ({ page }) => {
  const app = new App(page);
  await app.open(SHIPPED);
  await app.settled();
  const canvas = page.locator('.variation canvas').first();
  const picture = () => canvas.evaluate((card: HTMLCanvasElement) => card.toDataURL());
  const empty = await canvas.evaluate(({ width, height }: HTMLCanvasElement) =>
    Object.assign(document.createElement('canvas'), { width, height }).toDataURL(),
  );
  await expect.poll(picture).not.toBe(empty);
  const before = await picture();
  await page.getByRole('spinbutton', { name: /^Height of the reactor/ }).fill('220');
  await page.keyboard.press('Enter');
  await app.until(({ job, reaction }) => !job && reaction?.inputs.settings.height === 2.2);
  await expect.poll(picture).not.toBe(before);
  const { top, bottom, middle, edges, inside } = await canvas.evaluate((card: HTMLCanvasElement) => {
    const { width, height } = card;
    const { data } = card.getContext('2d')!.getImageData(0, 0, width, height);
    const rows: number[] = [];
    const reds = { edges: [] as number[], inside: [] as number[] };
    for (let i = 0; i < data.length; i += 4) {
      const opacity = data[i + 3]!;
      if (opacity === 0) continue;
      rows.push(Math.floor(i / 4 / width) / height);
      reds[opacity < 200 ? 'edges' : 'inside'].push(data[i]!);
    }
    const mean = (values: number[]): number => values.reduce((sum, value) => sum + value, 0) / values.length;
    return {
      top: Math.min(...rows),
      bottom: Math.max(...rows),
      middle: mean(rows),
      edges: mean(reds.edges),
      inside: mean(reds.inside),
    };
  });
  expect(top).toBeGreaterThan(0.05);
  expect(top).toBeLessThan(0.5);
  // More of a dancer is above half of their height than below, and no edge is drawn dark.
  expect(middle).toBeLessThan((top + bottom) / 2);
  expect(edges).toBeGreaterThan(0.75 * inside);
});
