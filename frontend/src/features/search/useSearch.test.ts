import { act, renderHook, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../harness/testing';
import { searchHere } from '../../../harness/searchWorker';
import { setSearch } from './searchStore';
import { useSearch } from './useSearch';

beforeEach(() => {
  searchHere();
  openProject({ texts: { 'a.py': 'speed' } });
});

const open = () => renderHook(() => useSearch()).result;

describe('useSearch', () => {
  it('does not search for an empty text', () => {
    expect(open().current).toEqual({ state: { kind: 'idle' }, isFresh: true });
  });

  it('finds, and searches again after an edit', async () => {
    const result = open();
    act(() => setSearch({ text: 'speed' }));
    await waitFor(() => expect(result.current.state).toMatchObject({ results: { count: 1 } }));
    act(() => useProjectStore.getState().setFileText('a.py', 'speed speed'));
    expect(result.current.isFresh).toBe(false);
    await waitFor(() => expect(result.current.state).toMatchObject({ results: { count: 2 } }));
    expect(result.current.isFresh).toBe(true);
  });

  it('reports why an expression is invalid', async () => {
    const result = open();
    act(() => setSearch({ text: '(', isRegex: true }));
    await waitFor(() =>
      expect(result.current.state).toEqual({ kind: 'wrong', reason: 'Unterminated group' }),
    );
  });
});
