import { TabNode, type Model, type TabSetNode } from 'flexlayout-react';
import { beforeEach, describe, expect, it } from 'vitest';
import { setViewMode } from '@/store/viewMode';
import { forgetLayouts, keepLayout, loadLayout, type PanelId } from './layoutModel';
import { showPanel, useTabs } from './tabs';

function panelsOf(model: Model): string[] {
  const found: string[] = [];
  model.visitNodes((node) => {
    if (node instanceof TabNode) found.push(node.getId());
  });
  return found;
}

const BASIC = ['palette', 'console', 'problems', 'viewer3d', 'video', 'inspector'];
const OTHERS: PanelId[] = [
  'explorer',
  'search',
  'outline',
  'library',
  'blackboard',
  'camera',
  'tests',
  'evaluate',
  'timeline',
  'breakpoints',
  'profile',
  'topics',
  'history',
];

const UNUSED: PanelId[] = ['breakpoints', 'profile'];

beforeEach(() => {
  localStorage.clear();
  setViewMode('basic');
});

describe.each(['wide', 'narrow'] as const)('the basic layout of a %s window', (width) => {
  it('has what a first project needs', () => {
    expect(panelsOf(loadLayout(width, true)).sort()).toEqual([...BASIC].sort());
  });

  it.each(OTHERS)('opens %s when it is used, and keeps it', (id) => {
    const model = loadLayout(width, true);
    useTabs.setState({ model, width });
    showPanel(id);
    const tab = model.getNodeById(id) as TabNode;
    expect((tab.getParent() as TabSetNode).getSelectedNode()?.getId()).toBe(id);
    expect(tab.isEnableClose()).toBe(true);
    showPanel(id);
    keepLayout(width, 'basic', model);
    expect(panelsOf(loadLayout(width, true)).sort()).toEqual([...BASIC, id].sort());
    expect(panelsOf(model).filter((each) => each === id)).toHaveLength(1);
  });

  it('is kept apart from the full one, which has every panel but those that wait for their use', () => {
    keepLayout(width, 'basic', loadLayout(width, true));
    setViewMode('full');
    const all = panelsOf(loadLayout(width, true));
    expect(all.sort()).toEqual([...BASIC, ...OTHERS.filter((id) => !UNUSED.includes(id))].sort());
    forgetLayouts();
    expect(Object.keys(localStorage)).toEqual(['bts.view']);
  });
});
