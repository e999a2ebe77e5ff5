/** Songs and leaders of any length for measurements. */
import { readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { root } from '../../run.mjs';

/**
 * The demo's leader, again and again.
 *
 * @param {string} file
 * @param {number} frames
 */
export async function writeLeader(file, frames) {
  const text = await readFile(path.join(root, 'web/public/demo/leader.bvh'), 'utf8');
  const [head = '', motion = ''] = text.split(/^Frames:.*\n/m);
  const [frameTime = '', ...rows] = motion.trim().split('\n');
  const repeated = Array.from({ length: frames }, (_, frame) => rows[frame % rows.length]);
  await writeFile(file, `${head}Frames: ${frames}\n${frameTime}\n${repeated.join('\n')}\n`);
}

const RATE = 22050;

/**
 * A click on every beat at 120 beats a minute, over a low note.
 *
 * @param {string} file a WAV
 * @param {number} seconds
 */
export async function writeSong(file, seconds) {
  const samples = Math.round(seconds * RATE);
  const data = Buffer.alloc(44 + 2 * samples);
  data.write('RIFF', 0);
  data.writeUInt32LE(36 + 2 * samples, 4);
  data.write('WAVEfmt ', 8);
  data.writeUInt32LE(16, 16);
  data.writeUInt16LE(1, 20);
  data.writeUInt16LE(1, 22);
  data.writeUInt32LE(RATE, 24);
  data.writeUInt32LE(2 * RATE, 28);
  data.writeUInt16LE(2, 32);
  data.writeUInt16LE(16, 34);
  data.write('data', 36);
  data.writeUInt32LE(2 * samples, 40);
  for (let i = 0; i < samples; i++) {
    const time = i / RATE;
    const click = Math.sin(2 * Math.PI * 900 * time) * Math.exp(-40 * (time % 0.5));
    data.writeInt16LE(
      Math.round(16000 * (0.6 * click + 0.2 * Math.sin(2 * Math.PI * 110 * time))),
      44 + 2 * i,
    );
  }
  await writeFile(file, data);
}
