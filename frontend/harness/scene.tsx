import { advance, createRoot, extend } from '@react-three/fiber';
import { act } from '@testing-library/react';
import type { ReactElement } from 'react';
import * as THREE from 'three';
import { onTestFinished, vi } from 'vitest';
import '@/features/viewer/scene/three';

// As <Canvas> does.
extend(THREE as unknown as Parameters<typeof extend>[0]);

const WIDTH = 400;
const HEIGHT = 300;

/** A canvas of 400 x 300 pixels; jsdom gives elements no size. */
export function testCanvas(): HTMLCanvasElement {
  const canvas = document.createElement('canvas');
  canvas.getBoundingClientRect = () => new DOMRect(0, 0, WIDTH, HEIGHT);
  document.body.append(canvas);
  onTestFinished(() => canvas.remove());
  return canvas;
}

/** A camera 10 m above the origin that looks straight down: x points right on the screen, y up. */
export function cameraAbove(): THREE.PerspectiveCamera {
  const camera = new THREE.PerspectiveCamera(90, WIDTH / HEIGHT, 0.05, 200);
  camera.position.set(0, 0, 10);
  camera.updateMatrixWorld(true);
  return camera;
}

/** The pixel at which a camera sees a point of the world, for an event. */
export function pixelOf(camera: THREE.Camera, x: number, y: number, z = 0) {
  camera.updateMatrixWorld(true);
  const seen = new THREE.Vector3(x, y, z).project(camera);
  return { clientX: ((seen.x + 1) / 2) * WIDTH, clientY: ((1 - seen.y) / 2) * HEIGHT };
}

/** A renderer that draws nothing and counts the frames. */
class CountingRenderer {
  frames = 0;
  readonly shadowMap = { enabled: false, type: THREE.PCFShadowMap };

  constructor(readonly domElement: HTMLCanvasElement) {}

  render(): void {
    this.frames += 1;
  }

  getContext(): unknown {
    return this.domElement.getContext('webgl2');
  }

  setPixelRatio(): void {}
  setSize(): void {}
  dispose(): void {}
}

/** Renders elements of a 3D view without WebGL: all but the drawing is real. */
export function showScene(element: ReactElement) {
  const canvas = testCanvas();
  const renderer = new CountingRenderer(canvas);
  const root = createRoot(canvas);
  void root.configure({
    gl: renderer as unknown as THREE.WebGLRenderer,
    frameloop: 'demand',
    dpr: 1,
    size: { width: WIDTH, height: HEIGHT, top: 0, left: 0 },
    camera: { fov: 45, near: 0.05, far: 200, up: [0, 0, 1], position: [-4, -4, 4] },
  });
  let store!: ReturnType<typeof root.render>;
  const render = (next: ReactElement) => {
    act(() => {
      store = root.render(next);
    });
  };
  render(element);
  onTestFinished(() => {
    act(() => root.unmount());
  });
  return {
    canvas,
    scene: store.getState().scene,
    camera: store.getState().camera,
    state: () => store.getState(),
    /** How many frames were drawn until now. */
    frames: () => renderer.frames,
    rerender: render,
    /** Draws a frame at once. */
    draw: () => {
      act(() => {
        advance(performance.now(), true, store.getState());
      });
    },
  };
}

/** The objects of a class in a scene, in their order. */
export function objectsOf<T extends THREE.Object3D>(root: THREE.Object3D, kind: { prototype: T }): T[] {
  const found: T[] = [];
  root.traverse((object) => {
    if (object instanceof (kind as unknown as abstract new () => T)) found.push(object);
  });
  return found;
}

/** Numbers of a geometry's attribute, rounded to 0.1 mm. */
export const valuesOf = (geometry: THREE.BufferGeometry, name = 'position'): number[] =>
  [...geometry.getAttribute(name).array].map((value) => Math.round(value * 1e4) / 1e4 + 0);

/** Lets the page find a WebGL of the given name; until the end of the file, since the page asks once. */
export function pretendWebGl(renderer: string): void {
  const gl = {
    RENDERER: 1,
    SYNC_GPU_COMMANDS_COMPLETE: 2,
    SYNC_STATUS: 3,
    SIGNALED: 4,
    getExtension: () => null,
    getParameter: () => renderer,
    fenceSync: () => null,
    flush: () => undefined,
  };
  Object.assign(HTMLCanvasElement.prototype, {
    getContext: (kind: string) => (kind === 'webgl2' ? gl : null),
  });
}

interface Loading {
  readonly address: string;
  /** Lets the picture arrive, so many pixels wide and high. */
  readonly arrive: (width?: number, height?: number) => THREE.Texture;
  readonly fail: () => void;
}

/** Pictures that are asked for from now on: jsdom loads none, so that a test says when they arrive. */
export function watchPictures(): Loading[] {
  const loading: Loading[] = [];
  URL.createObjectURL = () => `blob:${loading.length}`;
  URL.revokeObjectURL = () => undefined;
  vi.spyOn(THREE.TextureLoader.prototype, 'load').mockImplementation((address, onLoad, _, onError) => {
    const texture = new THREE.Texture<HTMLImageElement>();
    loading.push({
      address,
      arrive: (width = 1, height = 1) => {
        texture.image = { width, height } as HTMLImageElement;
        onLoad?.(texture);
        return texture;
      },
      fail: () => onError?.(new Error('no picture')),
    });
    return texture;
  });
  return loading;
}
