import { describe, expect, it } from 'vitest';
import { modelFolder } from '../../../../web/ui/files/dropped';

const dropped = (...paths: string[]) => paths.map((path) => ({ path, file: new File([path], path) }));

describe('what was dropped', () => {
  it('is a model where a manifest is among it, wherever its folder lies', () => {
    for (const root of ['', 'tango/', 'my models/tango/'])
      expect(
        Object.keys(
          modelFolder(dropped(`${root}step.onnx`, `${root}manifest.json`, `${root}parts/a.onnx`)) ?? {},
        ),
      ).toEqual(['step.onnx', 'manifest.json', 'parts/a.onnx']);
  });

  it('leaves out what lies beside the model', () => {
    const model = modelFolder(
      dropped('song.mp3', 'tango/manifest.json', 'tango/step.onnx', 'salsa/step.onnx'),
    );
    expect(Object.keys(model ?? {})).toEqual(['manifest.json', 'step.onnx']);
  });

  it('is no model without one', () => {
    expect(modelFolder(dropped('song.mp3', 'leader.bvh', 'not-a-manifest.json'))).toBeNull();
  });
});
