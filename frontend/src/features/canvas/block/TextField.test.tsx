import { fireEvent, screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../../harness/testing';
import { TextField } from './TextField';

function open() {
  const onFinish = vi.fn();
  const onKey = vi.fn();
  show(
    // eslint-disable-next-line jsx-a11y/no-static-element-interactions, jsx-a11y/no-noninteractive-tabindex
    <div data-testid="canvas" tabIndex={0} onKeyDown={({ key }) => onKey(key)}>
      <TextField label="Name" initial="Grasp" onFinish={onFinish} />
    </div>,
  );
  return { onFinish, onKey, field: screen.getByRole<HTMLInputElement>('textbox', { name: 'Name' }) };
}

describe('TextField', () => {
  it('starts with its text selected', () => {
    const { field } = open();
    expect(field).toHaveFocus();
    expect(field).toHaveValue('Grasp');
    expect(field).toHaveAttribute('placeholder', 'Name');
    expect([field.selectionStart, field.selectionEnd]).toEqual([0, 5]);
  });

  it('applies the text with Enter, and returns the focus to the canvas', async () => {
    const { onFinish } = open();
    await user.keyboard('Take');
    expect(onFinish).not.toHaveBeenCalled();
    await user.keyboard('{Enter}');
    expect(onFinish).toHaveBeenCalledExactlyOnceWith('Take');
    expect(screen.getByTestId('canvas')).toHaveFocus();
  });

  it('applies the text when the focus leaves it', async () => {
    const { onFinish, field } = open();
    await user.keyboard('Take');
    fireEvent.blur(field);
    expect(onFinish).toHaveBeenCalledExactlyOnceWith('Take');
  });

  it('discards the text with Escape', async () => {
    const { onFinish } = open();
    await user.keyboard('Take{Escape}');
    expect(onFinish).toHaveBeenCalledExactlyOnceWith('Grasp');
    expect(screen.getByTestId('canvas')).toHaveFocus();
  });

  it('keeps its keys from reaching the canvas', async () => {
    const { onKey } = open();
    await user.keyboard('a{Delete}{ArrowLeft}{Escape}');
    expect(onKey).not.toHaveBeenCalled();
  });
});
