import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useLiveValues, type LiveValue } from '@/store/session/values/live';
import { show } from '../../../../harness/testing';
import { PortValue } from './PortValue';

const PORT = 'Main/a/speed';
const set = (live: Partial<LiveValue> | null) => {
  const whole = { key: 'v', value: 0, changedAt: 1, samples: [], ...live };
  act(() => useLiveValues.setState({ values: new Map(live ? [[PORT, whole]] : []) }));
};
const value = () => screen.getByTestId(`value-${PORT}`);

beforeEach(() => {
  set(null);
  show(<PortValue port={PORT} text="{v}" />);
});

describe('PortValue', () => {
  it('shows the key until there is a value', () => {
    expect(value()).toHaveTextContent('{v}');
    expect(value()).not.toHaveAttribute('data-valued');
    expect(screen.getByTitle('Its value is shown here while the tree runs')).toBe(value());
  });

  it('shows the value, with its key in the title', () => {
    set({ value: 0.123456 });
    expect(value()).toHaveTextContent(/^0\.1235$/);
    expect(value()).toHaveAttribute('title', 'v = 0.1235');
    set(null);
    expect(value()).toHaveTextContent('{v}');
  });

  it('has a spark line as soon as there is a course', () => {
    set({ value: 1, samples: [1] });
    expect(value().querySelector('polyline')).toBeNull();
    set({ value: 2, samples: [1, 2] });
    expect(value().querySelector('polyline')).toHaveAttribute('points', '58.5,13.0 60.0,1.0');
  });
});
