import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import * as looking from '@/store/moment/looking';
import type { EntryName, WriteAt } from '@/store/recording/types';
import { show, user } from '../../../harness/testing';
import { Writes } from './Writes';

let tell: (writes: readonly WriteAt[]) => void = () => undefined;
const end = vi.fn();

beforeEach(() => {
  end.mockClear();
  vi.spyOn(looking, 'followWrites').mockImplementation((key: EntryName, told) => {
    expect(key).toEqual({ scope: 'In::1', key: 'goal' });
    tell = told;
    return end;
  });
});

const open = () =>
  show(
    <table>
      <tbody>
        <Writes row={{ scope: 'In::1', key: 'goal' }} />
      </tbody>
    </table>,
  );

const write = (more: Partial<WriteAt>): WriteAt => ({ t: 1, value: 1, isRemoved: false, by: 'Aim', ...more });

describe('Writes', () => {
  it('says that the recording is read, and that it holds none', () => {
    open();
    expect(screen.getByRole('status')).toHaveTextContent('Reading the recording');
    act(() => tell([]));
    expect(screen.getByRole('status')).toHaveTextContent('No write was recorded.');
  });

  it('lists time, value and writer, and goes to the moment of a click or of Enter', async () => {
    const look = vi.spyOn(looking, 'lookAt').mockReturnValue(undefined);
    open();
    act(() => tell([write({ t: 4.5, by: '' }), write({ t: 2, value: [1, 2] }), write({ isRemoved: true })]));
    const lines = screen.getAllByTestId('write');
    expect(lines.map(({ textContent }) => textContent)).toEqual([
      '4.50 s1not by a node',
      '2.00 s[1,2]Aim',
      '1.00 sremovedAim',
    ]);
    await user.click(lines[1]!);
    await user.keyboard('{Tab}{Enter}');
    expect(look.mock.calls).toEqual([[2], [1]]);
  });

  it('stops to follow the recording when it is closed', () => {
    const { unmount } = open();
    unmount();
    expect(end).toHaveBeenCalledOnce();
  });
});
