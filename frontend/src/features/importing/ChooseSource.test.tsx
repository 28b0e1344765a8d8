import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { show, user } from '../../../harness/testing';
import { ChooseSource } from './ChooseSource';

it('takes several files, or a folder', async () => {
  const onChoose = vi.fn();
  const { container } = show(<ChooseSource kind="universe" onChoose={onChoose} />);
  expect(screen.getByText(/A world of Gazebo as SDF/)).toBeInTheDocument();
  const [files, folder] = container.querySelectorAll<HTMLInputElement>('input[type=file]');
  expect(folder).toHaveAttribute('webkitdirectory');
  // The materials and pictures of a mesh can be chosen together with it.
  expect(files!.accept.split(',')).toEqual(expect.arrayContaining(['.obj', '.mtl', '.jpg', '.jpeg', '.tga']));
  await user.upload(files!, [new File(['a'], 'map.yaml'), new File(['b'], 'map.pgm')]);
  expect(onChoose.mock.calls[0]?.[0]).toMatchObject({ files: [{ path: 'map.yaml' }, { path: 'map.pgm' }] });
});
