import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import { watchPictures } from '../../../../harness/scene';
import { loadTexture, TextureCache } from './TextureCache';

const WOOD = { jpeg: new Uint8Array([1, 2, 3]), tile: [0.5, 2] };

describe('loadTexture', () => {
  it('makes a picture that repeats', () => {
    const [loading, done] = [watchPictures(), vi.fn()];
    loadTexture('/wood.jpg', 8, done);
    expect(loading[0]!.address).toBe('/wood.jpg');
    const texture = loading[0]!.arrive();
    expect(done).toHaveBeenCalledExactlyOnceWith(texture);
    expect(texture).toMatchObject({
      wrapS: THREE.RepeatWrapping,
      wrapT: THREE.RepeatWrapping,
      colorSpace: THREE.SRGBColorSpace,
      anisotropy: 8,
    });
  });

  it('returns null if it cannot be loaded', () => {
    const [loading, done] = [watchPictures(), vi.fn()];
    loadTexture('/wood.jpg', 8, done);
    loading[0]!.fail();
    expect(done).toHaveBeenCalledExactlyOnceWith(null);
  });
});

describe('TextureCache', () => {
  function cache() {
    const loading = watchPictures();
    const onLoaded = vi.fn();
    return {
      loading,
      onLoaded,
      textures: new TextureCache({ wood: WOOD, odd: { ...WOOD, tile: [] } }, onLoaded),
    };
  }

  it('decodes a picture once, for all that wait and all that come later', () => {
    const { loading, onLoaded, textures } = cache();
    const revoked = vi.spyOn(URL, 'revokeObjectURL');
    const takes = [vi.fn(), vi.fn(), vi.fn()];
    textures.whenLoaded('wood', takes[0]!);
    textures.whenLoaded('wood', takes[1]!);
    expect(loading).toHaveLength(1);
    expect(takes[0]).not.toHaveBeenCalled();
    const texture = loading[0]!.arrive();
    textures.whenLoaded('wood', takes[2]!);
    for (const take of takes) expect(take).toHaveBeenCalledExactlyOnceWith(texture);
    expect(onLoaded).toHaveBeenCalledOnce();
    expect(revoked).toHaveBeenCalledExactlyOnceWith(loading[0]!.address);
    expect(loading).toHaveLength(1);
    expect(texture.anisotropy).toBe(4);
  });

  it('has only the pictures of the scene', () => {
    const { loading, textures } = cache();
    textures.whenLoaded('brick', vi.fn());
    textures.whenLoaded('', vi.fn());
    expect(loading).toEqual([]);
    expect(textures.tileOf('wood')).toEqual([0.5, 2]);
    expect(textures.tileOf('odd')).toEqual([1, 1]);
    expect(textures.tileOf('brick')).toEqual([1, 1]);
  });

  it('never returns a damaged one', () => {
    const { loading, onLoaded, textures } = cache();
    const take = vi.fn();
    textures.whenLoaded('wood', take);
    loading[0]!.fail();
    textures.whenLoaded('wood', take);
    expect(take).not.toHaveBeenCalled();
    expect(onLoaded).not.toHaveBeenCalled();
  });

  it('frees pictures at its end, and returns none after it', () => {
    const { loading, onLoaded, textures } = cache();
    const [take, freed] = [vi.fn(), vi.fn()];
    textures.whenLoaded('wood', vi.fn());
    textures.whenLoaded('odd', take);
    loading[0]!.arrive().addEventListener('dispose', freed);
    textures.dispose();
    expect(freed).toHaveBeenCalledOnce();
    loading[1]!.arrive();
    expect(take).not.toHaveBeenCalled();
    expect(onLoaded).toHaveBeenCalledOnce();
  });
});
