import { FileButton } from '@mantine/core';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { chooseAgain } from './chooseAgain';

it('lets the same file be chosen twice', async () => {
  const onChange = vi.fn();
  show(
    <FileButton onChange={onChange} inputProps={chooseAgain}>
      {(props) => <button {...props}>choose</button>}
    </FileButton>,
  );
  const field = document.querySelector('input[type="file"]') as HTMLInputElement;
  const file = new File(['x'], 'a.zip');
  await user.upload(field, file);
  await user.upload(field, file);
  expect(onChange.mock.calls).toEqual([[file], [file]]);
});
