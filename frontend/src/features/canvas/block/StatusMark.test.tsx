import { describe, expect, it } from 'vitest';
import { show } from '../../../../harness/testing';
import { StatusMark } from './StatusMark';

type Props = Parameters<typeof StatusMark>[0];

const mark = (status: Props['status'], flash?: Props['flash'], past?: Props['past']) =>
  show(<StatusMark status={status} past={past} flash={flash} />).container.querySelector('span');

describe('StatusMark', () => {
  it.each(['RUNNING', 'SUCCESS', 'FAILURE', 'SKIPPED'] as const)('shows %s', (status) => {
    const shown = mark(status);
    expect(shown).toHaveAttribute('data-status', status);
    expect(shown?.className).not.toMatch(/passing/);
    expect(shown?.querySelector('svg')).not.toBeNull();
  });

  it('shows nothing while the node is idle', () => {
    expect(mark('IDLE')).toBeNull();
    expect(mark('IDLE', { status: 'IDLE', count: 1 })).toBeNull();
  });

  it('shows the statuses that an idle node had in the last tick', () => {
    const shown = mark('IDLE', { status: 'FAILURE', count: 2 });
    expect(shown).toHaveAttribute('data-status', 'FAILURE');
    expect(shown?.className).toMatch(/passing/);
  });

  it('shows the last tick at rest while the node is idle', () => {
    const shown = mark('IDLE', { status: 'SUCCESS', count: 2 }, 'FAILURE');
    expect(shown).toHaveAttribute('data-status', 'FAILURE');
    expect(shown?.className).toMatch(/past/);
    expect(shown?.className).not.toMatch(/passing/);
    expect(mark('RUNNING', undefined, 'FAILURE')).toHaveAttribute('data-status', 'RUNNING');
  });

  it('shows the status of a node that is not idle, whatever flashes', () => {
    const shown = mark('RUNNING', { status: 'FAILURE', count: 2 });
    expect(shown).toHaveAttribute('data-status', 'RUNNING');
    expect(shown?.className).not.toMatch(/passing/);
  });
});
