import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { setLanguage } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { useLessons } from '@/workspace/lessons';
import { nodeOf, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { LessonPanel } from './LessonPanel';

const trees = {
  Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep', ports: { msec: '1' } } },
};
const english = '# Waiting\n\nA **pause**. [Try it](try:set=Sleep.msec=500) <script>alert(1)</script>';

beforeEach(() => {
  localStorage.clear();
  setLanguage('en');
  useLessons.setState({ opens: true, closed: [] });
});

function open(texts: Record<string, string>) {
  openProject({ trees, texts });
  watchNavigation();
  show(<LessonPanel />);
}

describe('LessonPanel', () => {
  it('shows the lesson, with HTML as text', () => {
    open({ 'lessons/en.md': english });
    expect(screen.getByRole('heading', { name: 'Waiting' })).toBeInTheDocument();
    expect(screen.getByText(/<script>/)).toBeInTheDocument();
    expect(document.querySelector('script')).toBeNull();
  });

  it('does what a button says, and reports it', async () => {
    open({ 'lessons/en.md': english });
    await user.click(screen.getByRole('button', { name: 'Try it' }));
    expect(nodeOf('Main', 'a')?.ports).toEqual({ msec: '500' });
    expect(screen.getByRole('status')).toHaveTextContent('msec of “Sleep” is now 500.');
  });

  it('reports a missing block', async () => {
    open({ 'lessons/en.md': '[Try it](try:select=Gone)' });
    await user.click(screen.getByRole('button', { name: 'Try it' }));
    expect(screen.getByRole('status')).toHaveTextContent('There is no block “Gone” any more');
  });

  it('follows the language', () => {
    open({ 'lessons/en.md': english, 'lessons/es.md': '# Esperar' });
    act(() => setLanguage('es'));
    expect(screen.getByRole('heading', { name: 'Esperar' })).toBeInTheDocument();
    expect(screen.getByRole('checkbox', { name: 'Abrir las lecciones automáticamente' })).toBeChecked();
  });

  it('follows an edit of the lesson', () => {
    open({ 'lessons/en.md': english });
    act(() => useProjectStore.getState().setFileText('lessons/en.md', '# Changed'));
    expect(screen.getByRole('heading', { name: 'Changed' })).toBeInTheDocument();
  });

  it('offers to write one where there is none', async () => {
    open({});
    await user.click(screen.getByRole('button', { name: 'Write a lesson' }));
    expect(screen.getByRole('heading', { name: 'Lesson' })).toBeInTheDocument();
    expect(useProjectStore.getState().files['lessons/en.md']).toBeDefined();
  });

  it('stores whether lessons open by themselves', async () => {
    open({ 'lessons/en.md': english });
    await user.click(screen.getByRole('checkbox'));
    expect(JSON.parse(localStorage.getItem('bts.lessons')!)).toEqual({ opens: false, closed: [] });
  });
});
