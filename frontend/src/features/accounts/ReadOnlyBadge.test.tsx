import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { notifications } from '@mantine/notifications';
import { useProjectStore } from '@/store/project';
import { openProject, show } from '../../../harness/testing';
import { ReadOnlyBadge } from './ReadOnlyBadge';

const NOTE = /Duplicate it to work on a copy/;

it('shows that a project is read-only, and why an edit was refused', async () => {
  onTestFinished(() => notifications.clean());
  openProject({ texts: { 'notes.md': 'as it was' } });
  useProjectStore.setState({ role: 'viewer' });
  show(<ReadOnlyBadge />);
  expect(screen.getByTestId('read-only')).toHaveTextContent('Read only');
  expect(screen.queryByText(NOTE)).toBeNull();
  act(() => useProjectStore.getState().setFileText('notes.md', 'changed'));
  expect(await screen.findByText(NOTE)).toBeInTheDocument();
  expect(useProjectStore.getState().currentText('notes.md')).toBe('as it was');
});
