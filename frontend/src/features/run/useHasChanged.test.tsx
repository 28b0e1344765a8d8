import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useRunStore } from '@/store/run/store';
import { openProject, show } from '../../../harness/testing';
import { useHasChanged } from './useHasChanged';

function Page() {
  return <p>{useHasChanged() ? 'changed' : 'as it runs'}</p>;
}

it('compares the project with the running program', () => {
  onTestFinished(() => useRunStore.setState(useRunStore.getInitialState(), true));
  openProject({});
  const runs = () => act(() => useRunStore.setState({ ranAt: useProjectStore.getState().changeCounter }));
  runs();
  show(<Page />);
  expect(screen.getByText('as it runs')).toBeInTheDocument();
  act(() => useProjectStore.getState().addFile('a.md', ''));
  expect(screen.getByText('changed')).toBeInTheDocument();
  runs();
  expect(screen.getByText('as it runs')).toBeInTheDocument();
});
