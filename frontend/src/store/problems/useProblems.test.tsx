import { act, renderHook } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { useLanguageStore } from '@/store/language';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../harness/testing';
import { useProblems } from './useProblems';

it('is one list for all users, and follows the checked text', () => {
  onTestFinished(() => useLanguageStore.setState(useLanguageStore.getInitialState(), true));
  openProject({ trees: { Main: { r: { type: 'AlwaysSuccess' } } }, texts: { 'nodes/tones.py': '' } });
  const { result } = renderHook(() => [useProblems(), useProblems()] as const);
  expect(result.current[0]).toEqual([]);
  const place = { line: 0, character: 0 };
  const found = { from: place, to: place, severity: 'error', message: 'no', source: 'ty x' } as const;
  act(() => useLanguageStore.setState({ findings: { 'nodes/tones.py': [found] } }));
  expect(result.current[0].map(({ file }) => file)).toEqual(['nodes/tones.py']);
  expect(result.current[0]).toBe(result.current[1]);
  act(() => useProjectStore.getState().deleteFile('nodes/tones.py'));
  expect(result.current[0]).toEqual([]);
});
