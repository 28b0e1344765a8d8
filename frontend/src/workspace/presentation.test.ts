import type { Model } from 'flexlayout-react';
import { type TabNode } from 'flexlayout-react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { openProject } from '../../harness/testing';
import { loadLayout } from './layoutModel';
import {
  endPresentation,
  present,
  roleOf,
  toggleFullScreen,
  togglePresentation,
  toggleRobot,
  usePresentation,
} from './presentation';
import { followFront, openTab, useTabs } from './tabs';

const mode = () => usePresentation.getState().mode;
const open = (): Model => {
  const model = loadLayout('wide', true);
  useTabs.setState({ model, width: 'wide' });
  openTab({ kind: 'tree', id: 'Main' });
  followFront(model);
  return model;
};
const roles = (model: Model) => {
  const found: Record<string, string> = {};
  model.visitNodes((node) => {
    if (node.getType() !== 'tab') return;
    const role = roleOf(node as TabNode, usePresentation.getState());
    if (role) found[(node as TabNode).getName()] = role;
  });
  return found;
};

beforeEach(() => {
  localStorage.clear();
  openProject({ trees: { Main: { r: { type: 'Sequence' } }, Dock: { d: { type: 'Sequence' } } } });
  onTestFinished(() => {
    usePresentation.setState(usePresentation.getInitialState(), true);
    useTabs.setState(useTabs.getInitialState(), true);
  });
});

describe('a presentation', () => {
  it('shows the tree alone, until it ends', () => {
    const model = open();
    expect(roles(model)).toEqual({});
    togglePresentation();
    expect(roles(model)).toEqual({ Main: 'tree' });
    togglePresentation();
    expect(mode()).toBe('off');
    expect(roles(model)).toEqual({});
  });

  it('shows the robot beside it, and hides it again', () => {
    const model = open();
    present('robot');
    expect(roles(model)).toEqual({ Main: 'tree', 'panel.viewer3d': 'robot' });
    toggleRobot();
    expect(roles(model)).toEqual({ Main: 'tree' });
  });

  it('begins with the tree of before, where a file is in front', () => {
    const model = open();
    openTab({ kind: 'file', path: 'actions/Go.py' });
    followFront(model);
    present('tree');
    followFront(model);
    expect(roles(model)).toEqual({ Main: 'tree' });
  });

  it('follows the document that comes to the front', () => {
    const model = open();
    present('tree');
    openTab({ kind: 'tree', id: 'Dock' });
    followFront(model);
    expect(roles(model)).toEqual({ Dock: 'tree' });
  });

  it('shows a view that is in this window, or the tree alone', () => {
    open();
    useTabs.setState({ inWindows: ['viewer3d'] });
    present('robot');
    expect(usePresentation.getState()).toMatchObject({ mode: 'robot', view: 'video' });
    useTabs.setState({ inWindows: ['viewer3d', 'video', 'camera'] });
    present('robot');
    expect(mode()).toBe('tree');
  });
});

describe('the full screen', () => {
  let element: Element | null = null;
  const exit = vi.fn(() => Promise.resolve());

  beforeEach(() => {
    element = null;
    exit.mockClear();
    Object.defineProperty(document, 'fullscreenElement', { configurable: true, get: () => element });
    document.exitFullscreen = exit;
    document.documentElement.requestFullscreen = () => {
      element = document.documentElement;
      return Promise.resolve();
    };
  });

  it('ends with the presentation that asked for it', async () => {
    open();
    present('tree');
    await toggleFullScreen();
    expect(usePresentation.getState().isFull).toBe(true);
    endPresentation();
    expect(exit).toHaveBeenCalledTimes(1);
  });

  it('can be left alone', async () => {
    open();
    present('tree');
    await toggleFullScreen();
    await toggleFullScreen();
    expect(exit).toHaveBeenCalledTimes(1);
    expect(usePresentation.getState()).toMatchObject({ mode: 'tree', isFull: false });
  });

  it('may be refused', async () => {
    document.documentElement.requestFullscreen = () => Promise.reject(new Error('no'));
    await toggleFullScreen();
    expect(usePresentation.getState().isFull).toBe(false);
  });
});
