import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../harness/testing';
import { isOnCanvas, isTreeInFront } from './inFront';

let isVisible = true;

beforeEach(() => {
  isVisible = true;
  // jsdom has no layout.
  Element.prototype.checkVisibility = () => isVisible;
  document.body.innerHTML = `
    <div data-testid="canvas" data-tree="Main" tabindex="0"><input id="inner"></div>
    <input id="outer">`;
  openProject({ trees: { Main: { r: { type: 'Sequence' } }, Dock: { d: { type: 'Sequence' } } } });
});

const focus = (selector: string) => document.querySelector<HTMLElement>(selector)!.focus();

describe('isOnCanvas', () => {
  it('is true for the canvas and the elements in it', () => {
    focus('[data-testid="canvas"]');
    expect(isOnCanvas()).toBe(true);
    focus('#inner');
    expect(isOnCanvas()).toBe(true);
    focus('#outer');
    expect(isOnCanvas()).toBe(false);
  });
});

describe('isTreeInFront', () => {
  it('is true while the canvas of the active tree is visible', () => {
    expect(isTreeInFront()).toBe(true);
    isVisible = false;
    expect(isTreeInFront()).toBe(false);
    isVisible = true;
    useProjectStore.getState().setActiveTree('Dock');
    expect(isTreeInFront()).toBe(false);
  });
});
