import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { action, openProject, show, user, watchNavigation } from '../../../../harness/testing';
import { OutdatedPorts } from './OutdatedPorts';

it('opens the line of the error', async () => {
  const diagnostics = [{ code: 'BT0601', severity: 'error', message: 'bad', line: 7 }] as const;
  openProject({ actions: [action('Go', { outdated: true, diagnostics: [...diagnostics] })] });
  const { openFile } = watchNavigation();
  show(<OutdatedPorts action="Go" />);
  expect(screen.getByRole('status')).toHaveTextContent('cannot be read');
  await user.click(screen.getByRole('button', { name: 'Go.py, line 7' }));
  expect(openFile).toHaveBeenCalledWith('actions/Go.py', 7);
});
