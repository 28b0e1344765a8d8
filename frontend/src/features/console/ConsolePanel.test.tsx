import { MantineProvider } from '@mantine/core';
import { act, fireEvent, render, screen, waitFor } from '@testing-library/react';
import userEvent from '@testing-library/user-event';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import '@/i18n';
import { setNavigator } from '@/store/project/navigation';
import { useProjectStore } from '@/store/project';
import { appendLogs, initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import type { Log } from '@/generated/messages';
import { parseAnsi, plainText } from './ansi';
import { ConsolePanel } from './ConsolePanel';
import { filterLines } from './filter';
import { findLinks } from './links';

const log = (text: string, more: Partial<Log> = {}): Log => ({
  source: 'action',
  level: 'info',
  text,
  node_id: '',
  node_path: '',
  time: 1,
  launch_node: '',
  ...more,
});

const FILES = new Set(['actions/Forward.py']);

describe('parseAnsi', () => {
  it('keeps styles until they are reset', () => {
    expect(parseAnsi('a\u001b[1;31mb\u001b[0mc')).toEqual([
      { text: 'a', styles: [] },
      { text: 'b', styles: ['bold', 'red'] },
      { text: 'c', styles: [] },
    ]);
  });

  it('drops sequences that are no style', () => {
    expect(plainText('x\u001b[2Ky')).toBe('xy');
    expect(parseAnsi('\u001b[2K')).toEqual([{ text: '', styles: [] }]);
  });
});

describe('findLinks', () => {
  it.each([
    ['Forward.py:12', 12],
    ['actions/Forward.py:7', 7],
    ['File "actions/Forward.py", line 30, in update', 30],
  ])('finds the line in %s', (text, line) => {
    expect(findLinks(text, FILES)[0]).toMatchObject({ path: 'actions/Forward.py', line });
  });

  it('leaves files alone that are not of the project', () => {
    expect(findLinks('lib/other.py:3', FILES)).toEqual([{ text: 'lib/other.py:3' }]);
  });
});

describe('filterLines', () => {
  it('filters by source, level and text', () => {
    const { logs } = appendLogs({ logs: [], nextLogId: 1 }, [
      log('hello'),
      log('careful', { level: 'warning', source: 'world' }),
      log('why', { level: 'debug' }),
    ]);
    const texts = (filter: Partial<Parameters<typeof filterLines>[1]>) =>
      filterLines(logs, { source: 'all', level: 'debug', search: '', ...filter }).map(({ text }) => text);
    expect(texts({ level: 'warning' })).toEqual(['careful']);
    expect(texts({ source: 'world' })).toEqual(['careful']);
    expect(texts({ search: 'HELL' })).toEqual(['hello']);
  });
});

describe('ConsolePanel', () => {
  beforeEach(() => {
    // jsdom has no layout; the list of visible rows needs a height to fill.
    vi.spyOn(Element.prototype, 'clientHeight', 'get').mockReturnValue(300);
    vi.spyOn(Element.prototype, 'clientWidth', 'get').mockReturnValue(600);
    useSessionStore.setState(initialSession, true);
    useProjectStore.setState({
      files: {
        'actions/Forward.py': {
          path: 'actions/Forward.py',
          kind: 'text',
          text: '',
          revision: 1,
          savedText: '',
        },
      },
    });
  });

  const show = () =>
    render(
      <MantineProvider>
        <ConsolePanel />
      </MantineProvider>,
    );

  it('says what will be there before the first run', () => {
    show();
    expect(screen.getByText(/The output of your actions/)).toBeInTheDocument();
  });

  it('opens the line that a link names', async () => {
    const openFile = vi.fn();
    setNavigator({ openTree: vi.fn(), aimAt: vi.fn(), renamed: vi.fn(), openFile });
    act(() => {
      useSessionStore.setState(appendLogs(initialSession, [log('see Forward.py:12')]));
    });
    show();
    await userEvent.click(await screen.findByRole('button', { name: 'Forward.py:12' }));
    expect(openFile).toHaveBeenCalledWith('actions/Forward.py', 12);
  });

  it('follows the end until one goes up, whatever else scrolls', () => {
    useSessionStore.setState(appendLogs(initialSession, [log('one'), log('two')]));
    show();
    const scroller = screen.getByRole('log');
    const scroll = (top: number, height: number) => {
      Object.defineProperties(scroller, {
        scrollHeight: { value: height, configurable: true },
        clientHeight: { value: 100, configurable: true },
        scrollTop: { value: top, configurable: true, writable: true },
      });
      fireEvent.scroll(scroller);
    };
    const toEnd = () => screen.queryByRole('button', { name: 'Follow the end' });
    scroll(400, 500);
    scroll(410, 900);
    expect(toEnd()).toBeNull();
    // Fewer lines after a search, or a panel that was hidden.
    scroll(300, 900);
    expect(toEnd()).toBeNull();
    fireEvent.wheel(scroller);
    scroll(200, 900);
    expect(toEnd()).not.toBeNull();
    scroll(790, 900);
    expect(toEnd()).toBeNull();
  });

  it('does not scroll while something in it is pressed', async () => {
    useSessionStore.setState(appendLogs(initialSession, [log('one')]));
    show();
    const scroller = screen.getByRole('log');
    Object.defineProperties(scroller, {
      scrollHeight: { value: 900, configurable: true },
      scrollTop: { value: 100, configurable: true, writable: true },
    });
    fireEvent.pointerDown(scroller);
    act(() => useSessionStore.setState((state) => appendLogs(state, [log('two')])));
    expect(scroller.scrollTop).toBe(100);
    fireEvent.pointerUp(scroller);
    await waitFor(() => {
      expect(scroller.scrollTop).toBe(900);
    });
  });
});
