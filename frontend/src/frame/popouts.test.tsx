import { waitFor } from '@testing-library/react';
import { notifications } from '@mantine/notifications';
import { Actions, Model, TabNode, TabSetNode } from 'flexlayout-react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { setLanguage } from '@/i18n';
import { loadLayout } from '@/workspace/layoutModel';
import { popOut, Popouts } from './popouts';
import { useTabs } from '@/workspace/tabs';

let model: Model;
let popouts: Popouts;

const tab = (id: string): TabNode => {
  const node = model.getNodeById(id);
  if (!(node instanceof TabNode)) throw new Error(`${id} is no tab`);
  return node;
};
const isInWindow = (id: string) => tab(id).getLayoutId() !== Model.MAIN_LAYOUT_ID;
const neighboursOf = (id: string) =>
  tab(id)
    .getParent()
    ?.getChildren()
    .map((each) => each.getId());
/** Calls the handlers that the docking library calls when a window has opened, and when it closes. */
const opened = (id: string) => {
  const page = document.implementation.createHTMLDocument();
  popouts.onOpen({ getLayoutId: () => tab(id).getLayoutId() }, window, page);
  return page;
};
const closed = (id: string) => popouts.onAction(Actions.closePopout(tab(id).getLayoutId()));

beforeEach(() => {
  localStorage.clear();
  model = loadLayout('wide', true);
  popouts = new Popouts(model);
  useTabs.setState({ model, width: 'wide' });
});

describe('panels in windows of their own', () => {
  it('open, and return to their places when the window closes', () => {
    const before = neighboursOf('video');
    popOut('video');
    expect(isInWindow('video')).toBe(true);
    opened('video');
    expect(closed('video')).toBeUndefined();
    expect(isInWindow('video')).toBe(false);
    expect(neighboursOf('video')).toEqual(before);
  });

  it('return beside similar panels if their place is gone', () => {
    for (const id of ['inspector', 'blackboard'] as const) {
      if (id === 'inspector') model.doAction(Actions.deleteTab(id));
      else popOut(id);
    }
    opened('blackboard');
    closed('blackboard');
    expect(isInWindow('blackboard')).toBe(false);
    expect(tab('blackboard').getParent()).toBeInstanceOf(TabSetNode);
  });

  it('follow theme and language, also in their titles', async () => {
    popOut('blackboard');
    const page = opened('blackboard');
    expect(page.title).toBe('Blackboard — BT Studio');
    document.documentElement.setAttribute('data-mantine-color-scheme', 'dark');
    setLanguage('es');
    onTestFinished(() => setLanguage('en'));
    await waitFor(() => expect(page.title).toBe('Pizarra — BT Studio'));
    expect(page.documentElement.lang).toBe('es');
    expect(page.documentElement.getAttribute('data-mantine-color-scheme')).toBe('dark');
  });

  it('stay in the stored layout', () => {
    popOut('console');
    model = Model.fromJson(model.toJson());
    expect(isInWindow('console')).toBe(true);
  });

  it('return with a notification when the browser opens no window', () => {
    const told = vi.spyOn(notifications, 'show').mockReturnValue('');
    popOut('viewer3d');
    closed('viewer3d');
    expect(isInWindow('viewer3d')).toBe(false);
    expect(told).toHaveBeenCalledWith(
      expect.objectContaining({ title: 'The browser did not open a window for 3D.' }),
    );
  });
});
