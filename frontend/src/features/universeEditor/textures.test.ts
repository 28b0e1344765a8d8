import * as THREE from 'three';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import tiles from '@/generated/textures/tiles.json';
import { openProject } from '../../../harness/testing';
import { watchPictures } from '../../../harness/scene';
import { EditorTextures, pictureName } from './textures';

const made = () => {
  const redraw = vi.fn();
  const textures = new EditorTextures(redraw, 8);
  textures.onArrival = vi.fn();
  return { textures, redraw };
};

beforeEach(() => {
  openProject({ texts: {} });
});

describe('pictureName', () => {
  it('has the size of a repetition only if it is set', () => {
    expect(pictureName('wood', [0.5, 2])).toBe('wood@0.5x2');
    expect(pictureName('wood', null)).toBe('wood');
    expect(pictureName('', [1, 1])).toBe('');
  });
});

describe('EditorTextures', () => {
  it('loads a picture once, whatever the size of its repetition', () => {
    const loading = watchPictures();
    const { textures, redraw } = made();
    const [first, second, late] = [vi.fn(), vi.fn(), vi.fn()];
    textures.whenLoaded('assets/my wall.png', first);
    textures.whenLoaded('assets/my wall.png@2x1', second);
    textures.whenLoaded('', late);
    expect(loading.map(({ address }) => address)).toEqual(['/api/v1/projects/p1/files/assets/my%20wall.png']);
    expect(textures.has('assets/my wall.png')).toBe(false);
    expect(first).not.toHaveBeenCalled();
    const texture = loading[0]!.arrive();
    expect(first).toHaveBeenCalledExactlyOnceWith(texture);
    expect(second).toHaveBeenCalledExactlyOnceWith(texture);
    expect(textures.onArrival).toHaveBeenCalledOnce();
    expect(redraw).toHaveBeenCalledOnce();
    expect(textures.has('assets/my wall.png@2x1')).toBe(true);
    textures.whenLoaded('assets/my wall.png', late);
    expect(late).toHaveBeenCalledExactlyOnceWith(texture);
    expect([texture.wrapS, texture.wrapT, texture.anisotropy]).toEqual([
      THREE.RepeatWrapping,
      THREE.RepeatWrapping,
      8,
    ]);
    expect(texture.colorSpace).toBe(THREE.SRGBColorSpace);
  });

  it('loads the built-in ones from the page itself', () => {
    const loading = watchPictures();
    made().textures.has('brick');
    expect(loading[0]!.address).toMatch(/generated\/textures\/brick\.jpg/);
  });

  it('repeat as the universe says, otherwise by their own size', () => {
    const loading = watchPictures();
    const { textures } = made();
    expect(textures.tileOf('wood@0.5x2e-1')).toEqual([0.5, 0.2]);
    expect(textures.tileOf('wood')).toEqual(tiles.wood);
    textures.has('assets/a.png');
    expect(textures.tileOf('assets/a.png')).toEqual([1, 1]);
    loading[0]!.arrive(200, 100);
    expect(textures.tileOf('assets/a.png')).toEqual([1, 0.5]);
  });

  it('reports a picture that cannot be loaded, and returns none', () => {
    const loading = watchPictures();
    const { textures, redraw } = made();
    const take = vi.fn();
    textures.whenLoaded('assets/a.png', take);
    loading[0]!.fail();
    expect(take).not.toHaveBeenCalled();
    expect(redraw).toHaveBeenCalledOnce();
    expect(textures.has('assets/a.png')).toBe(false);
    expect(textures.has('')).toBe(false);
  });

  it('frees pictures, also one that arrives after its end', () => {
    const loading = watchPictures();
    const { textures, redraw } = made();
    const freed = vi.fn();
    textures.has('assets/a.png');
    textures.has('assets/b.png');
    loading[0]!.arrive().addEventListener('dispose', freed);
    textures.dispose();
    expect(freed).toHaveBeenCalledOnce();
    const late = vi.spyOn(THREE.Texture.prototype, 'dispose');
    loading[1]!.arrive();
    expect(late).toHaveBeenCalledOnce();
    expect(redraw).toHaveBeenCalledOnce();
  });
});
