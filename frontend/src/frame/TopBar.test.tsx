import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import type { DocumentTab } from '@/workspace/documents';
import { useTabs } from '@/workspace/tabs';
import { openProject, show } from '../../harness/testing';
import { TopBar } from './TopBar';

it('names the document in front: a tree, or an open file by its path', () => {
  openProject({ trees: { Main: {} } });
  onTestFinished(() => useTabs.setState(useTabs.getInitialState(), true));
  show(<TopBar />);
  const crumb = () => screen.getByTestId('crumb').textContent;
  const bring = (front: DocumentTab) => act(() => useTabs.setState({ front }));
  bring({ kind: 'tree', id: 'Main' });
  expect(crumb()).toBe('Main');
  bring({ kind: 'file', path: 'actions/Go.py' });
  expect(crumb()).toBe('actions/Go.py');
  expect(screen.getByTestId('crumb')).toHaveAttribute('title', 'actions/Go.py');
});
