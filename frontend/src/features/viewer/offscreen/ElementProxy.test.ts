import { describe, expect, it, vi } from 'vitest';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import * as THREE from 'three';
import { ElementProxy } from './ElementProxy';

const SIZE = { width: 400, height: 300, dpr: 1 };

describe('the stand-in for the canvas', () => {
  it('has the size of the canvas, at the origin of the events', () => {
    const proxy = new ElementProxy(vi.fn());
    proxy.resize(SIZE);
    expect([proxy.clientWidth, proxy.clientHeight]).toEqual([400, 300]);
    expect(proxy.getBoundingClientRect()).toMatchObject({ left: 0, top: 0, width: 400, height: 300 });
  });

  it('reports a cursor once, until it is another one', () => {
    const onCursor = vi.fn();
    const proxy = new ElementProxy(onCursor);
    for (const cursor of ['grab', 'grab', 'grabbing']) proxy.style.cursor = cursor;
    expect(onCursor.mock.calls).toEqual([['grab'], ['grabbing']]);
    expect(proxy.style.cursor).toBe('grabbing');
  });

  it('turns a camera by the events that it receives', () => {
    const proxy = new ElementProxy(vi.fn());
    proxy.resize(SIZE);
    const camera = new THREE.PerspectiveCamera();
    camera.position.set(5, 0, 2);
    const controls = new OrbitControls(camera, proxy as unknown as HTMLElement);
    controls.update();
    const start = camera.position.clone();
    const pointer = { pointerId: 1, pointerType: 'mouse', button: 0 };
    proxy.receive({ type: 'pointerdown', ...pointer, clientX: 10, clientY: 10 });
    proxy.receive({ type: 'pointermove', ...pointer, clientX: 110, clientY: 10 });
    proxy.receive({ type: 'pointerup', ...pointer, clientX: 110, clientY: 10 });
    controls.update();
    expect(camera.position.distanceTo(start)).toBeGreaterThan(1);
    controls.dispose();
  });

  it('lets a tool take an event before the controls see it', () => {
    const proxy = new ElementProxy(vi.fn());
    const later = vi.fn();
    proxy.addEventListener('pointerdown', later);
    proxy.addEventListener('pointerdown', (event) => event.stopImmediatePropagation(), { capture: true });
    proxy.receive({ type: 'pointerdown', button: 0 });
    expect(later).not.toHaveBeenCalled();
  });
});
