import { TabNode, TabSetNode, type Model } from 'flexlayout-react';
import { beforeEach, describe, expect, it } from 'vitest';
import { cameraOf, chooseCamera, openAnotherCamera, openCameraBelow } from './cameraViews';
import { keepLayout, loadLayout } from './layoutModel';
import { useTabs } from './tabs';

let model: Model;

const view = (id: string): TabNode => {
  const node = model.getNodeById(id);
  if (!(node instanceof TabNode)) throw new Error(`${id} is no tab`);
  return node;
};

beforeEach(() => {
  localStorage.clear();
  model = loadLayout('wide', true);
  useTabs.setState({ model, width: 'wide' });
});

describe('views of cameras', () => {
  it('keep their choices in the layout', () => {
    expect(cameraOf(view('camera'))).toBeNull();
    chooseCamera(view('camera'), 'front');
    openCameraBelow(view('camera'), 'rear');
    keepLayout('wide', 'full', model);
    model = loadLayout('wide', true);
    expect(cameraOf(view('camera'))).toBe('front');
    expect(cameraOf(view('camera:2'))).toBe('rear');
  });

  it('open below each other, and are closed by the user', () => {
    openCameraBelow(view('camera'), 'rear');
    openCameraBelow(view('camera:2'), null);
    expect(view('camera:2').getParent()).not.toBe(view('camera').getParent());
    const below = view('camera:2').getParent();
    expect(below instanceof TabSetNode && below.getSelectedNode()?.getId()).toBe('camera:2');
    expect(view('camera:3').getComponent()).toBe('camera');
    expect([view('camera').isEnableClose(), view('camera:2').isEnableClose()]).toEqual([false, true]);
  });

  it('open as one more tab in a narrow window', () => {
    useTabs.setState({ width: 'narrow' });
    openAnotherCamera();
    expect(view('camera:2').getParent()).toBe(view('camera').getParent());
  });
});
