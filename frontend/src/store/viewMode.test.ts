import { beforeEach, expect, it, vi } from 'vitest';
import type { ViewMode } from './viewMode';

async function opened() {
  vi.resetModules();
  return import('./viewMode');
}

const mode = async (): Promise<ViewMode> => (await opened()).useViewMode.getState().mode;

beforeEach(() => localStorage.clear());

it('is basic in a new browser, and stays so after its layout is kept', async () => {
  expect(await mode()).toBe('basic');
  localStorage.setItem('bts.layout.1.wide.basic', '{}');
  expect(await mode()).toBe('basic');
});

it('is full where panels were arranged before there was a choice', async () => {
  localStorage.setItem('bts.layout.1.wide', '{}');
  expect(await mode()).toBe('full');
  localStorage.removeItem('bts.layout.1.wide');
  expect(await mode()).toBe('full');
});

it('is kept', async () => {
  const { setViewMode } = await opened();
  setViewMode('full');
  expect(await mode()).toBe('full');
});

it('applies while a project is shown, since other pages have no switch', async () => {
  const { showsProject, useViewMode } = await opened();
  expect(useViewMode.getState().isInProject).toBe(false);
  const end = showsProject();
  expect(useViewMode.getState()).toEqual({ mode: 'basic', isInProject: true });
  end();
  expect(useViewMode.getState().isInProject).toBe(false);
});
