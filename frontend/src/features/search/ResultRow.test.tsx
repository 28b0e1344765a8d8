import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Passage } from '@/model/search/passages';
import { useProjectStore } from '@/store/project';
import { openProject, show, user, watchNavigation } from '../../../harness/testing';
import { ResultRow } from './ResultRow';

const onReplace = vi.fn();
const inTree = (part: 'name' | 'type', text: string): Passage => ({
  path: 'trees/Main.json',
  place: { node: 'a', field: { part } },
  text,
});
const inFile: Passage = { path: 'actions/Go.py', place: null, text: 'one\n  go = go\n' };

function open(passage: Passage, more: { isReplacing?: boolean; isFresh?: boolean } = {}) {
  const hit = { text: 0, start: passage.text.indexOf('go'), end: passage.text.indexOf('go') + 2 };
  show(
    <ResultRow
      row={{ passage, hit: { ...hit, replacement: 'run' } }}
      isReplacing={more.isReplacing ?? false}
      isFresh={more.isFresh ?? true}
      onReplace={onReplace}
    />,
  );
}

const row = () => document.querySelector<HTMLElement>('[data-row]')!;

beforeEach(() => {
  openProject({ trees: { Main: { a: { type: 'go', name: 'go home' } } } });
});

describe('ResultRow', () => {
  it('marks the hit in its line, and opens the line', async () => {
    const { openFile } = watchNavigation();
    open(inFile);
    expect(row()).toHaveTextContent('go = goLine 2');
    expect(document.querySelector('mark')).toHaveTextContent('go');
    await user.click(row());
    expect(openFile).toHaveBeenCalledWith('actions/Go.py', 2);
  });

  it('names block and field, and opens the block', async () => {
    const { openTree } = watchNavigation();
    open(inTree('name', 'go home'));
    expect(row()).toHaveTextContent('go homego home · name');
    await user.click(row());
    expect(openTree).toHaveBeenCalledWith('Main');
    expect(useProjectStore.getState().selection).toEqual(['a']);
  });

  it('shows the replacement instead of the hit', async () => {
    open(inFile, { isReplacing: true });
    expect(document.querySelector('del')).toHaveTextContent('go');
    expect(document.querySelector('ins')).toHaveTextContent('run');
    await user.click(screen.getByRole('button', { name: 'Replace this one' }));
    expect(onReplace).toHaveBeenCalledOnce();
  });

  it('shows no outdated replacement', () => {
    open(inFile, { isReplacing: true, isFresh: false });
    expect(document.querySelector('ins')).toBeNull();
    expect(screen.getByRole('button', { name: 'Replace this one' })).toBeDisabled();
  });

  it('is locked if it is a reference', () => {
    open(inTree('type', 'go'), { isReplacing: true });
    expect(screen.getByRole('img', { name: /Rename that instead/ })).toBeInTheDocument();
    expect(screen.queryByRole('button', { name: 'Replace this one' })).toBeNull();
  });
});
