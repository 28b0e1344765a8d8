import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { ChoiceCards } from './ChoiceCards';

const ITEMS = [
  { id: '', name: 'Default', description: 'As it is.' },
  { id: 'room', name: 'Room', description: 'Small.', preview: '/room.jpg' },
  { id: 'none', name: 'None', description: 'Outside.' },
  { id: 'hall', name: 'Hall', description: 'Wide.' },
];

function cards(chosen: string, isFirst?: boolean) {
  const onChoose = vi.fn();
  const { container } = show(
    <ChoiceCards
      label="Where"
      items={ITEMS}
      chosen={chosen}
      onChoose={onChoose}
      {...(isFirst === undefined ? {} : { isFirst })}
    />,
  );
  return { onChoose, container };
}

describe('ChoiceCards', () => {
  it('are radio buttons of one group, with their labels', async () => {
    const { onChoose } = cards('room');
    expect(screen.getByRole('radiogroup', { name: 'Where' })).toBeInTheDocument();
    const radios = screen.getAllByRole<HTMLInputElement>('radio');
    expect(radios.map(({ checked }) => checked)).toEqual([false, true, false, false]);
    expect(new Set(radios.map(({ name }) => name)).size).toBe(1);
    expect(screen.getByTestId('choice-default')).toHaveTextContent('DefaultAs it is.');
    await user.click(screen.getByTestId('choice-hall'));
    expect(onChoose).toHaveBeenCalledExactlyOnceWith('hall');
  });

  it('show a picture, or an icon', () => {
    const { container } = cards('room');
    expect(container.querySelectorAll('img')).toHaveLength(1);
    expect(screen.getByTestId('choice-room').querySelector('img')).toHaveAttribute('src', '/room.jpg');
    const symbol = (id: string) =>
      screen.getByTestId(`choice-${id}`).querySelector('svg')?.getAttribute('class');
    expect(symbol('default')).toContain('robot');
    expect(symbol('none')).toContain('plug-connected');
    expect(symbol('hall')).toContain('world');
  });

  it('put the focus of a dialogue on the chosen card, if they come first', () => {
    expect(cards('room', true).container.querySelectorAll('[data-autofocus]')).toHaveLength(1);
    expect(screen.getByDisplayValue('room')).toHaveAttribute('data-autofocus');
  });

  it('otherwise leave the focus to others', () => {
    expect(cards('room').container.querySelector('[data-autofocus]')).toBeNull();
  });
});
