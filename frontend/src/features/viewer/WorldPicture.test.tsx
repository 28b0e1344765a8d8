import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import type { Scene } from '@/generated/messages';
import { pretendWebGl } from '../../../harness/scene';
import { show } from '../../../harness/testing';
import type { View } from './offscreen/messages';
import { loadViewOptions } from './viewOptions';
import { WorldPicture } from './WorldPicture';

pretendWebGl('NVIDIA');

const SCENE: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1, 1],
  sensors: [],
};
const VIEW: View = {
  options: loadViewOptions(),
  ...{ isDark: false, isVisible: false, isJudged: true, canMove: false },
  measuring: { isOn: false, points: [] },
};

const workers: { onerror: () => void; onmessage?: (event: { data: { kind: string } }) => void }[] = [];

beforeEach(() => {
  workers.length = 0;
  HTMLCanvasElement.prototype.transferControlToOffscreen = () => ({}) as OffscreenCanvas;
  vi.stubGlobal(
    'OffscreenCanvas',
    class {
      getContext = () => ({ getExtension: () => null });
    },
  );
  vi.stubGlobal(
    'Worker',
    class {
      onerror = vi.fn<() => void>();
      postMessage = vi.fn();
      terminate = vi.fn();

      constructor() {
        workers.push(this);
      }
    },
  );
  onTestFinished(() => {
    vi.unstubAllGlobals();
    Reflect.deleteProperty(HTMLCanvasElement.prototype, 'transferControlToOffscreen');
  });
});

it('lets a worker draw, and draws itself if the worker fails', () => {
  show(<WorldPicture scene={SCENE} view={VIEW} onTurned={vi.fn()} onSlow={vi.fn()} />);
  expect(workers).toHaveLength(1);
  const first = screen.getByRole('img').querySelector('canvas')!;
  act(() => workers[0]!.onerror());
  expect(first).not.toBeInTheDocument();
  expect(screen.getByRole('img').querySelector('canvas')).toBeInTheDocument();
  expect(workers).toHaveLength(1);
});

it('says that it loads until the first picture is drawn', async () => {
  show(<WorldPicture scene={SCENE} view={VIEW} onTurned={vi.fn()} onSlow={vi.fn()} />);
  expect(await screen.findByText('Loading 3D…')).toBeInTheDocument();
  act(() => workers[0]!.onmessage!({ data: { kind: 'drawn' } }));
  expect(screen.queryByText('Loading 3D…')).toBeNull();
  act(() => workers[0]!.onerror());
  expect(await screen.findByText('Loading 3D…')).toBeInTheDocument();
});
