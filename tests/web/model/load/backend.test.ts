import { afterEach, describe, expect, it, vi } from 'vitest';
import { chooseBackend, fallBackToWasm, type Environment } from '../../../../web/model/load/backend';

/** A machine whose WebGPU finds this adapter. */
function machine(adapter: Partial<GPUAdapterInfo> | null | Error, isolated = true, cores = 8): Environment {
  return {
    gpu: {
      requestAdapter: () =>
        adapter instanceof Error
          ? Promise.reject(adapter)
          : Promise.resolve(
              adapter === null ? null : ({ info: { isFallbackAdapter: false, ...adapter } } as GPUAdapter),
            ),
    },
    isSecureContext: true,
    crossOriginIsolated: isolated,
    hardwareConcurrency: cores,
  };
}
const card = { vendor: 'acme', architecture: 'rocket-2', description: '' };

describe('chooseBackend', () => {
  it('takes a real graphics adapter and names it', async () => {
    expect(await chooseBackend('auto', machine(card))).toEqual({
      name: 'webgpu',
      reason: 'WebGPU on acme rocket-2.',
      threads: 4,
    });
  });

  it.each<[string, Environment, RegExp]>([
    [
      'no WebGPU',
      { isSecureContext: true, crossOriginIsolated: true, hardwareConcurrency: 2 },
      /one thread: this browser has no WebGPU/,
    ],
    [
      'plain http',
      { isSecureContext: false, crossOriginIsolated: false, hardwareConcurrency: 8 },
      /one thread: WebGPU works over https or on localhost only/,
    ],
    ['no adapter', machine(null), /found no graphics adapter/],
    ['a software adapter', machine({ ...card, isFallbackAdapter: true }), /only a software adapter/],
    ['an error', machine(new Error('lost')), /could not be asked .*lost/],
  ])('uses the processor with %s and says why', async (_, around, reason) => {
    const backend = await chooseBackend('auto', around);
    expect(backend.name).toBe('wasm');
    expect(backend.reason).toMatch(reason);
  });

  it('takes an adapter of a browser that says nothing about it', async () => {
    const requestAdapter = () => Promise.resolve({} as GPUAdapter);
    const backend = await chooseBackend('auto', { ...machine(card), gpu: { requestAdapter } });
    expect(backend).toMatchObject({ name: 'webgpu', reason: 'WebGPU on a graphics adapter.' });
  });

  describe('when WebGPU never answers', () => {
    afterEach(() => vi.useRealTimers());

    it('goes on with the processor', async () => {
      vi.useFakeTimers();
      const gpu = { requestAdapter: () => new Promise<never>(() => undefined) };
      let backend: unknown;
      void chooseBackend('auto', { ...machine(card), gpu }).then((chosen) => (backend = chosen));
      await vi.advanceTimersByTimeAsync(10_000);
      expect(backend).toMatchObject({
        name: 'wasm',
        reason: expect.stringMatching(/could not be asked .*nothing for 10 seconds/) as string,
      });
    });
  });

  it('takes a software adapter only when WebGPU was asked for', async () => {
    const around = machine({ ...card, description: 'SwiftShader', isFallbackAdapter: true });
    expect((await chooseBackend('webgpu', around)).reason).toBe('WebGPU on SwiftShader.');
  });

  it('takes the chosen backend, leaves a core to the page, and uses threads only where memory can be shared', async () => {
    expect(await chooseBackend('wasm', machine(card))).toMatchObject({ name: 'wasm', threads: 4 });
    expect(await chooseBackend('wasm', machine(card, true, 2))).toMatchObject({ threads: 1 });
    expect(await chooseBackend('wasm', machine(card, true, 4))).toMatchObject({ threads: 3 });
    expect(await chooseBackend('wasm', machine(card, true, 1))).toMatchObject({ threads: 1 });
    expect(await chooseBackend('wasm', machine(card, true, 2), 2)).toMatchObject({ threads: 2 });
    expect(await chooseBackend('wasm', machine(card, false), 2)).toMatchObject({ threads: 1 });
    expect(await chooseBackend('wasm', machine(card), 1)).toMatchObject({ threads: 1 });
    expect(await chooseBackend('wasm', machine(card, false))).toMatchObject({
      threads: 1,
      reason: 'Processor, one thread: chosen in the address of the page.',
    });
  });

  it('falls back to wasm with a reason', async () => {
    const backend = fallBackToWasm(await chooseBackend('auto', machine(card)), 'The GPU is upside down');
    expect(backend).toEqual({
      name: 'wasm',
      reason: 'The GPU is upside down, so the processor is used.',
      threads: 4,
    });
  });
});
