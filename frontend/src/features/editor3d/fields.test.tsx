import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { lookOnly } from '../../../harness/documents';
import { openProject, show, user } from '../../../harness/testing';
import { ColorField, FieldGroup, NumberField, TextField } from './fields';

describe('NumberField', () => {
  function field(more: Partial<Parameters<typeof NumberField>[0]> = {}) {
    openProject({});
    const onCommit = vi.fn();
    const { rerender } = show(
      <NumberField label="Mass" value={2} testId="mass" onCommit={onCommit} {...more} />,
    );
    return { input: screen.getByTestId('mass'), onCommit, rerender };
  }
  const type = async (input: HTMLElement, text: string) => {
    await user.clear(input);
    await user.type(input, text);
  };

  it('applies a number on Enter, or when the focus leaves it', async () => {
    const { input, onCommit } = field();
    await type(input, '3.5');
    expect(onCommit).not.toHaveBeenCalled();
    await user.keyboard('{Enter}');
    expect(onCommit).toHaveBeenLastCalledWith(3.5);
    await type(input, '4');
    await user.tab();
    expect(onCommit).toHaveBeenLastCalledWith(4);
  });

  it('reports nothing for the same number, to a tenth of a millimetre', async () => {
    const { input, onCommit } = field({ value: 2.00004 });
    expect(input).toHaveValue('2');
    await type(input, '2{Enter}');
    await type(input, '2.00002{Enter}');
    await user.tab();
    expect(onCommit).not.toHaveBeenCalled();
  });

  it('restores the number after invalid text', async () => {
    const { input, onCommit } = field();
    await type(input, '-{Enter}');
    expect(input).toHaveValue('2');
    await user.clear(input);
    await user.tab();
    expect(input).toHaveValue('2');
    expect(onCommit).not.toHaveBeenCalled();
  });

  it.each([
    [{ min: 1, max: 5 }, '0.5', 1],
    [{ min: 1, max: 5 }, '9', 5],
    [{}, '123456', 10_000],
    [{}, '-123456', -10_000],
  ])('stays in its range %o', async (range, text, kept) => {
    const { input, onCommit } = field(range);
    await type(input, `${text}{Enter}`);
    expect(onCommit).toHaveBeenCalledExactlyOnceWith(kept);
  });

  it('steps with the arrows, tenfold with Shift', async () => {
    const { input, onCommit } = field({ step: 0.5 });
    for (const keys of [
      '{ArrowUp}',
      '{ArrowDown}',
      '{Shift>}{ArrowUp}{/Shift}',
      '{Shift>}{ArrowDown}{/Shift}',
    ])
      await user.type(input, keys);
    expect(onCommit.mock.calls).toEqual([[2.5], [1.5], [7], [-3]]);
  });

  it('steps by a tenth by default, from the typed number', async () => {
    const { input, onCommit } = field();
    await user.type(input, '{ArrowUp}');
    expect(onCommit).toHaveBeenLastCalledWith(2.1);
    await type(input, '5{ArrowDown}');
    expect(onCommit).toHaveBeenLastCalledWith(4.9);
    await type(input, '-{ArrowUp}');
    expect(onCommit).toHaveBeenLastCalledWith(0.1);
  });

  it('shows its unit', () => {
    expect(field({ unit: 'kg' }).input).toHaveValue('2 kg');
  });

  it('cannot be edited in a read-only project', () => {
    openProject({});
    lookOnly();
    show(<NumberField label="Mass" value={2} onCommit={vi.fn()} />);
    expect(screen.getByLabelText('Mass')).toBeDisabled();
  });
});

describe('TextField', () => {
  function field(more: Partial<Parameters<typeof TextField>[0]> = {}) {
    openProject({});
    const onCommit = vi.fn();
    show(<TextField label="Name" value="crate" testId="name" onCommit={onCommit} {...more} />);
    return { input: screen.getByTestId('name'), onCommit };
  }

  it('applies a text on Enter or when the focus leaves it, unless it is unchanged', async () => {
    const { input, onCommit } = field();
    await user.type(input, 's');
    expect(onCommit).not.toHaveBeenCalled();
    await user.keyboard('{Enter}');
    expect(onCommit).toHaveBeenLastCalledWith('crates');
    await user.type(input, '2');
    await user.tab();
    expect(onCommit).toHaveBeenLastCalledWith('crates2');
    onCommit.mockClear();
    await user.clear(input);
    await user.type(input, 'crate{Enter}');
    expect(onCommit).not.toHaveBeenCalled();
  });

  it('discards the text on Escape', async () => {
    const { input, onCommit } = field();
    await user.type(input, 's{Escape}');
    expect(input).toHaveValue('crate');
    await user.tab();
    expect(onCommit).not.toHaveBeenCalled();
  });

  it('reports why a text is invalid, except for the current one', async () => {
    const { input, onCommit } = field({ problem: (text) => `not ${text}` });
    expect(screen.queryByText('not crate')).toBeNull();
    expect(input).toBeValid();
    await user.type(input, 's');
    expect(screen.getByText('not crates')).toBeInTheDocument();
    await user.keyboard('{Enter}');
    expect(onCommit).not.toHaveBeenCalled();
    expect(input).toHaveValue('crate');
  });

  it('shows a placeholder while it is empty', () => {
    expect(field({ value: '', placeholder: '/scan' }).input).toHaveAttribute('placeholder', '/scan');
  });
});

describe('ColorField', () => {
  it('accepts only complete colours', async () => {
    openProject({});
    const onChange = vi.fn();
    const onEnd = vi.fn();
    show(<ColorField label="Colour" value="#112233" onChange={onChange} onEnd={onEnd} />);
    const input = screen.getByRole('textbox', { name: 'Colour' });
    await user.clear(input);
    await user.type(input, '#4455');
    expect(onChange).not.toHaveBeenCalled();
    await user.type(input, '66');
    expect(onChange).toHaveBeenLastCalledWith('#445566');
    onEnd.mockClear();
    await user.tab();
    expect(onEnd).toHaveBeenCalled();
  });

  it('keeps the transparency', async () => {
    openProject({});
    const onChange = vi.fn();
    show(<ColorField label="Colour" value="#11223344" onChange={onChange} onEnd={vi.fn()} />);
    const input = screen.getByRole('textbox', { name: 'Colour' });
    expect(input).toHaveValue('#11223344');
    await user.clear(input);
    await user.type(input, '#44556677');
    expect(onChange).toHaveBeenLastCalledWith('#44556677');
  });

  it('offers a dozen colours', async () => {
    openProject({});
    const onChange = vi.fn();
    show(<ColorField label="Colour" value="#112233" onChange={onChange} onEnd={vi.fn()} />);
    await user.click(screen.getByRole('textbox', { name: 'Colour' }));
    const swatches = await screen.findAllByRole('button', { name: /^#[0-9a-f]{6}$/ });
    expect(swatches).toHaveLength(12);
    await user.click(swatches[7]!);
    expect(onChange).toHaveBeenLastCalledWith('#20c020');
  });
});

describe('FieldGroup', () => {
  it('has a title, and three columns by default', () => {
    show(
      <>
        <FieldGroup title="Size">a</FieldGroup>
        <FieldGroup title="Drive" columns={2}>
          b
        </FieldGroup>
      </>,
    );
    expect(screen.getByRole('group', { name: 'Size' })).toHaveAttribute('data-columns', '3');
    expect(screen.getByRole('group', { name: 'Drive' })).toHaveAttribute('data-columns', '2');
  });
});
