import { beforeEach, describe, expect, it } from 'vitest';
import { keepViewOptions, loadViewOptions } from './viewOptions';

beforeEach(() => localStorage.clear());

describe('the options of the 3D view', () => {
  it('have the useful helpers at first', () => {
    expect(loadViewOptions()).toEqual({
      rays: true,
      trail: true,
      grid: true,
      frames: false,
      frustum: true,
      follow: true,
      camera: null,
      viewpoint: { kind: 'default' },
    });
  });

  it('are stored, except for the direction of the camera', () => {
    keepViewOptions({ ...loadViewOptions(), rays: false, camera: true, viewpoint: { kind: 'top' } });
    expect(localStorage.getItem('bts.viewer')).not.toMatch(/viewpoint|follow/);
    expect(loadViewOptions()).toMatchObject({ rays: false, camera: true, viewpoint: { kind: 'default' } });
  });

  it('are the defaults if the stored ones are unreadable, or lack some', () => {
    localStorage.setItem('bts.viewer', '{');
    expect(loadViewOptions().rays).toBe(true);
    localStorage.setItem('bts.viewer', '{"grid": false}');
    expect(loadViewOptions()).toMatchObject({ grid: false, rays: true });
  });
});
