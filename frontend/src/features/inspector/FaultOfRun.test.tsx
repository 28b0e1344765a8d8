import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { show, user, watchNavigation } from '../../../harness/testing';
import { FaultOfRun } from './FaultOfRun';

type Fault = ReturnType<typeof useSessionStore.getState>['faults'][number];

const fault = (more: Partial<Fault>): Fault =>
  ({
    tree_id: 'Main',
    node_id: 'a',
    kind: 'exception',
    file: '',
    line: 0,
    hint: '',
    message: '',
    ...more,
  }) as Fault;

function open(...faults: Fault[]) {
  useSessionStore.setState({ ...initialSession, faults });
  show(<FaultOfRun tree="Main" id="a" message="boom" />);
  return screen.getByTestId('fault-of-run');
}

beforeEach(() => {
  useSessionStore.setState(initialSession);
});

describe('FaultOfRun', () => {
  it('shows what failed, even without details', () => {
    expect(open()).toHaveTextContent('An action failed: boom');
    expect(screen.queryByRole('button')).toBeNull();
  });

  it('has the hint of the last fault of this block', () => {
    const item = open(
      fault({ hint: 'First.' }),
      fault({ hint: 'Last.' }),
      fault({ node_id: 'b', hint: 'Of b.' }),
      fault({ tree_id: 'Dock', hint: 'Of Dock.' }),
    );
    expect(item).toHaveTextContent('Last.');
    expect(item).not.toHaveTextContent(/First|Of/);
  });

  it('opens the line', async () => {
    const { openFile } = watchNavigation();
    open(fault({ file: 'actions/Drive.py', line: 7 }));
    const button = screen.getByRole('button', { name: /Drive\.py/ });
    expect(button).toHaveTextContent('7');
    expect(button).not.toHaveTextContent('actions/');
    await user.click(button);
    expect(openFile).toHaveBeenCalledExactlyOnceWith('actions/Drive.py', 7);
  });

  it.each([fault({ file: 'actions/Drive.py', line: 0 }), fault({ file: '', line: 7 })])(
    'opens nothing without a file and a line',
    (each) => {
      open(each);
      expect(screen.queryByRole('button')).toBeNull();
    },
  );
});
