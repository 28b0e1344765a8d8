import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { api } from '@/api/client';
import { queries } from '@/api/queries';
import { show } from '../../../../harness/testing';
import { useInterfaceFields, useInterfaceNames } from './useInterfaces';

function Shown({ type, ports }: { readonly type: string; readonly ports: Record<string, string> }) {
  const names = useInterfaceNames(type);
  const fields = useInterfaceFields({ type, ports });
  return (
    <p>
      {names?.join(' ') ?? 'none'} | {fields?.map(({ port }) => port).join(' ') ?? 'open'}
    </p>
  );
}

beforeEach(() => {
  queries.clear();
  vi.spyOn(api, 'interfaces').mockResolvedValue([
    { name: 'nav2_msgs/action/Wait', kind: 'action' },
    { name: 'std_srvs/srv/Trigger', kind: 'srv' },
  ]);
  vi.spyOn(api, 'interfaceFields').mockResolvedValue([
    { port: 'goal__time', direction: 'input', type: 'any', ros: 'builtin_interfaces/Duration' },
  ]);
});

describe('the interfaces for a block', () => {
  it('are those of its kind, with the fields of the chosen one', async () => {
    show(<Shown type="RosAction" ports={{ action_type: 'nav2_msgs/Wait' }} />);
    expect(await screen.findByText('nav2_msgs/action/Wait | goal__time')).toBeVisible();
  });

  it('leave the block open while its type is not installed', async () => {
    show(<Shown type="RosAction" ports={{ action_type: 'other_msgs/action/Go' }} />);
    expect(await screen.findByText('nav2_msgs/action/Wait | open')).toBeVisible();
    expect(api.interfaceFields).not.toHaveBeenCalled();
  });

  it('are not asked for by other blocks', () => {
    show(<Shown type="Sequence" ports={{}} />);
    expect(screen.getByText('none | open')).toBeVisible();
    expect(api.interfaces).not.toHaveBeenCalled();
  });
});
