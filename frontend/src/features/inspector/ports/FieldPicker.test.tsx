import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../../harness/testing';
import { FieldPicker } from './FieldPicker';

const fields = [
  { port: 'goal__pose', direction: 'input', type: 'any', ros: 'geometry_msgs/PoseStamped' },
  { port: 'goal__behavior_tree', direction: 'input', type: 'string', ros: 'string' },
] as const;

describe('the list of an interface’s fields', () => {
  it('gives the chosen field, and leaves out those that the block has', async () => {
    const done = vi.fn();
    show(<FieldPicker fields={fields} taken={['goal__pose']} onDone={done} />);
    await user.click(screen.getByTestId('field-picker'));
    expect(screen.queryByRole('option', { name: /goal\.pose/ })).toBeNull();
    await user.click(await screen.findByRole('option', { name: 'goal.behavior_tree · string' }));
    expect(done).toHaveBeenCalledExactlyOnceWith(fields[1]);
  });

  it('is left by Escape', async () => {
    const done = vi.fn();
    show(<FieldPicker fields={fields} taken={[]} onDone={done} />);
    await user.type(screen.getByTestId('field-picker'), '{Escape}');
    expect(done).toHaveBeenCalledExactlyOnceWith(null);
  });
});
