import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { choose } from '../../../../harness/documents';
import { openProject, show, user } from '../../../../harness/testing';
import { TextureField } from './TextureField';

function field(value: string) {
  openProject({ texts: { 'assets/wall.PNG': '', 'assets/floor.jpeg': '', 'assets/a.txt': '' } });
  const onChange = vi.fn();
  show(<TextureField value={value} onChange={onChange} />);
  return { onChange, input: screen.getByRole('combobox', { name: 'Texture' }) };
}

const options = async (input: HTMLElement) => {
  await user.click(input);
  return (await screen.findAllByRole('option')).map(({ textContent }) => textContent);
};

describe('TextureField', () => {
  it('offers none, the built-in ones, and pictures of the project', async () => {
    const { input } = field('');
    expect(await options(input)).toEqual([
      'None',
      ...['Asphalt', 'Brick', 'Carpet', 'Checker', 'Grass', 'Tiles', 'Wood'],
      ...['assets/wall.PNG', 'assets/floor.jpeg'],
    ]);
  });

  it('still offers a deleted picture while it is chosen', async () => {
    const { input } = field('assets/gone.png');
    expect(input).toHaveValue('assets/gone.png');
    expect(await options(input)).toContain('assets/gone.png');
  });

  it.each([
    ['assets/wall.PNG', 'assets/wall.PNG'],
    ['brick', 'Brick'],
  ])('lists the chosen picture %s once', async (value, label) => {
    expect((await options(field(value).input)).filter((each) => each === label)).toHaveLength(1);
  });

  it('reports the choice; none is undefined', async () => {
    const { input, onChange } = field('brick');
    await choose(input, 'Wood');
    expect(onChange).toHaveBeenLastCalledWith('wood');
    await choose(input, 'None');
    expect(onChange).toHaveBeenLastCalledWith(undefined);
  });
});
