import type { TabSetNode } from 'flexlayout-react';
import { Actions, type Model } from 'flexlayout-react';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { toggleBreakpoint, useBreakpoints } from '@/store/debug/breakpoints';
import { useProfile } from '@/store/debug/profile';
import { toggleLine, useLines } from '@/store/python/lines';
import { setViewMode } from '@/store/viewMode';
import { openProject } from '../../harness/testing';
import { loadLayout, UNTIL_USED } from './layoutModel';
import { showPanel, useTabs } from './tabs';
import { followUse } from './usedPanels';

const trees = { Main: { r: { type: 'Sequence' } } };
let model: Model;
let end: () => void;

const open = () => {
  model = loadLayout('wide', true);
  useTabs.setState({ model, width: 'wide' });
};
const used = () => UNTIL_USED.filter((id) => model.getNodeById(id));
const isSeen = (id: string) =>
  (model.getNodeById(id)?.getParent() as TabSetNode).getSelectedNode()?.getId() === id;

beforeEach(() => {
  localStorage.clear();
  useBreakpoints.setState({ list: [] });
  useLines.setState({ list: [] });
  useProfile.setState({ isWanted: false });
  openProject({ trees });
});
afterEach(() => end());

it.each(['basic', 'full'] as const)('adds each panel of the %s page once it is used', (mode) => {
  setViewMode(mode);
  open();
  end = followUse();
  expect(used()).toEqual([]);
  toggleBreakpoint('Main', 'r');
  expect(used()).toEqual(['breakpoints']);
  expect(isSeen('breakpoints')).toBe(false);
  expect(isSeen('console')).toBe(true);
  useProfile.setState({ isWanted: true });
  expect(used()).toEqual(['breakpoints', 'profile']);
});

it('counts a line of Python, and what another layout lacks', () => {
  setViewMode('full');
  open();
  end = followUse();
  toggleLine('actions/Turn.py', 3);
  expect(used()).toEqual(['breakpoints']);
  open();
  expect(used()).toEqual(['breakpoints']);
});

it('leaves a tab closed that the user has closed, until the next use', () => {
  setViewMode('full');
  open();
  end = followUse();
  toggleBreakpoint('Main', 'r');
  model.doAction(Actions.deleteTab('breakpoints'));
  toggleLine('actions/Turn.py', 3);
  expect(used()).toEqual([]);
  toggleLine('actions/Turn.py', 3);
  toggleBreakpoint('Main', 'r');
  toggleBreakpoint('Main', 'r');
  expect(used()).toEqual(['breakpoints']);
});

it('opens one at any time, in front', () => {
  setViewMode('full');
  open();
  end = followUse();
  showPanel('profile');
  expect(isSeen('profile')).toBe(true);
});
