import { createEvent, fireEvent, screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { PortNameInput } from './PortNameInput';

function open(before?: string) {
  const onDone = vi.fn();
  show(
    <PortNameInput {...(before === undefined ? {} : { before })} taken={['goal', 'pose']} onDone={onDone} />,
  );
  return { onDone, field: screen.getByRole<HTMLInputElement>('textbox', { name: 'Name of the port' }) };
}

describe('PortNameInput', () => {
  it('starts empty, or with the current name', () => {
    const { field } = open();
    expect(field).toHaveFocus();
    expect(field).toHaveValue('');
    expect(field).toBeValid();
  });

  it('selects the present name', () => {
    const { field } = open('goal');
    expect([field.selectionStart, field.selectionEnd]).toEqual([0, 4]);
    expect(field).toBeValid();
  });

  it('reports the name on Enter, once', async () => {
    const { onDone, field } = open();
    await user.type(field, 'aim{Enter}');
    fireEvent.blur(field);
    expect(onDone).toHaveBeenCalledExactlyOnceWith('aim', true);
  });

  it('reports the name when the focus leaves it', async () => {
    const { onDone, field } = open();
    await user.type(field, 'aim');
    expect(onDone).not.toHaveBeenCalled();
    await user.tab();
    expect(onDone).toHaveBeenCalledExactlyOnceWith('aim', false);
  });

  it('changes nothing with Escape, which does not leave the panel', async () => {
    const { onDone, field } = open();
    await user.type(field, 'aim');
    const letter = createEvent.keyDown(field, { key: 'a' });
    fireEvent(field, letter);
    expect(letter.defaultPrevented).toBe(false);
    const event = createEvent.keyDown(field, { key: 'Escape' });
    fireEvent(field, event);
    expect(event.defaultPrevented).toBe(true);
    expect(onDone).toHaveBeenCalledExactlyOnceWith(null, false);
  });

  it('changes nothing if the name is the same', () => {
    const { onDone, field } = open('goal');
    fireEvent.blur(field);
    expect(onDone).toHaveBeenCalledExactlyOnceWith(null, false);
  });

  it.each([
    ['pose', 'There is a port of that name already.'],
    ['3d', /^A letter first/],
    ['name', /^A letter first/],
  ])('refuses “%s” and says why', async (name, message) => {
    const { onDone, field } = open('goal');
    await user.clear(field);
    await user.type(field, `${name}{Enter}`);
    expect(screen.getByText(message)).toBeInTheDocument();
    expect(field).toBeInvalid();
    expect(onDone).not.toHaveBeenCalled();
    fireEvent.blur(field);
    expect(onDone).toHaveBeenCalledExactlyOnceWith(null, false);
  });
});
