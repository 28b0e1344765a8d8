import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../../harness/testing';
import { TypeInput } from './TypeInput';

describe('the field for the type of a ROS interface', () => {
  it('offers the installed types, and takes others', async () => {
    const change = vi.fn();
    show(
      <TypeInput
        name="action_type"
        labelledBy="label"
        value=""
        types={['nav2_msgs/action/Wait', 'nav2_msgs/action/Spin']}
        error={false}
        onChange={change}
      />,
    );
    await user.click(screen.getByTestId('port-action_type'));
    await user.click(await screen.findByRole('option', { name: 'nav2_msgs/action/Spin' }));
    expect(change).toHaveBeenLastCalledWith('nav2_msgs/action/Spin');
    await user.type(screen.getByTestId('port-action_type'), 'm');
    expect(change).toHaveBeenLastCalledWith('m');
  });
});
