import { MantineProvider } from '@mantine/core';
import { act, fireEvent, render, screen, waitFor } from '@testing-library/react';
import userEvent from '@testing-library/user-event';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import '@/i18n';
import { setNavigator } from '@/store/project/navigation';
import { useProjectStore } from '@/store/project';
import { appendLogs, initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import type { LaunchNode, Log } from '@/generated/messages';
import { ConsolePanel } from './ConsolePanel';
import { useConsoleFilter } from './filter';

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

describe('ConsolePanel', () => {
  beforeEach(() => {
    // jsdom has no layout, but the list of visible rows needs a height.
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

  it('explains before the first run what it will show', () => {
    show();
    expect(screen.getByText(/The output of your actions/)).toBeInTheDocument();
  });

  it('opens the line that a link names', async () => {
    const openFile = vi.fn();
    setNavigator({
      openTree: vi.fn(),
      showTree: vi.fn(() => true),
      aimAt: vi.fn(),
      renamed: vi.fn(),
      openTopics: vi.fn(),
      focusField: vi.fn(),
      showFile: vi.fn(),
      openFile,
    });
    act(() => {
      useSessionStore.setState(appendLogs(initialSession, [log('see Forward.py:12')]));
    });
    show();
    await userEvent.click(await screen.findByRole('button', { name: 'Forward.py:12' }));
    expect(openFile).toHaveBeenCalledWith('actions/Forward.py', 12);
  });

  it('follows the end until the user scrolls up, whatever else scrolls', () => {
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
    // The list became shorter by a search or because the panel was hidden.
    scroll(300, 900);
    expect(toEnd()).toBeNull();
    fireEvent.wheel(scroller);
    scroll(200, 900);
    expect(toEnd()).not.toBeNull();
    scroll(790, 900);
    expect(toEnd()).toBeNull();
  });

  it('follows the end if something else scrolls while a line is pressed, and stops if it is dragged', () => {
    useSessionStore.setState(appendLogs(initialSession, [log('one'), log('two')]));
    show();
    const scroller = screen.getByRole('log');
    const scroll = (top: number) => {
      Object.defineProperties(scroller, {
        scrollHeight: { value: 900, configurable: true },
        clientHeight: { value: 100, configurable: true },
        scrollTop: { value: top, configurable: true, writable: true },
      });
      fireEvent.scroll(scroller);
    };
    const toEnd = () => screen.queryByRole('button', { name: 'Follow the end' });
    scroll(410);
    fireEvent.pointerDown(screen.getByText('two'));
    scroll(300);
    expect(toEnd()).toBeNull();
    fireEvent.pointerMove(screen.getByText('two'));
    scroll(200);
    expect(toEnd()).not.toBeNull();
    fireEvent.pointerUp(scroller);
    scroll(800);
    fireEvent.pointerDown(scroller);
    scroll(300);
    expect(toEnd()).not.toBeNull();
  });

  it('does not scroll while a line is pressed', async () => {
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

  const write = (...lines: Log[]) => act(() => useSessionStore.setState((state) => appendLogs(state, lines)));
  const texts = () =>
    [...screen.getByRole('log').querySelectorAll('[data-level]')].map((line) => line.lastChild?.textContent);

  it('filters by text, source and level', async () => {
    onTestFinished(() => useConsoleFilter.setState(useConsoleFilter.getInitialState(), true));
    show();
    write(
      log('hello'),
      log('careful', { level: 'warning', source: 'world' }),
      log('why', { level: 'debug' }),
    );
    expect(texts()).toEqual(['hello', 'careful']);
    const [source, level] = ['Source', 'Level'].map((name) => screen.getByRole('combobox', { name }));
    expect([...(source as HTMLSelectElement).options].map(({ text }) => text)).toEqual([
      'All sources',
      'Actions',
      'World',
      'Manager',
      'Launch',
    ]);
    await userEvent.selectOptions(level!, 'Debug and above');
    expect(texts()).toEqual(['hello', 'careful', 'why']);
    await userEvent.selectOptions(source!, 'Actions');
    expect(texts()).toEqual(['hello', 'why']);
    await userEvent.type(screen.getByRole('searchbox', { name: 'Search the output' }), 'wx');
    expect(screen.getByText('No line matches the filter.')).toBeInTheDocument();
  });

  it('filters by a launch node of the run, even after it has ended', async () => {
    onTestFinished(() => useConsoleFilter.setState(useConsoleFilter.getInitialState(), true));
    const node = { id: 'n1', name: 'mapper' } as LaunchNode;
    useSessionStore.setState({ launchNodes: [node] });
    show();
    write(log('map', { source: 'launch', launch_node: 'n1' }), log('hello'));
    const source = screen.getByRole('combobox', { name: 'Source' });
    await userEvent.selectOptions(source, 'Node mapper');
    expect(texts()).toEqual(['map']);
    act(() => useSessionStore.setState({ launchNodes: [] }));
    expect((source as HTMLSelectElement).selectedOptions[0]?.text).toBe('n1');
    expect(texts()).toEqual(['map']);
  });

  it('clears all lines on demand', async () => {
    show();
    const clear = screen.getByRole('button', { name: 'Clear' });
    expect(clear).toBeDisabled();
    write(log('hello'));
    await userEvent.click(clear);
    expect(useSessionStore.getState().logs).toEqual([]);
    expect(await screen.findByText(/The output of your actions/)).toBeInTheDocument();
  });

  it('follows the end again on demand', async () => {
    show();
    write(log('one'));
    const scroller = screen.getByRole('log');
    Object.defineProperties(scroller, {
      scrollHeight: { value: 900, configurable: true },
      clientHeight: { value: 100, configurable: true },
      scrollTop: { value: 100, configurable: true, writable: true },
    });
    fireEvent.scroll(scroller);
    fireEvent.keyDown(scroller);
    scroller.scrollTop = 50;
    fireEvent.scroll(scroller);
    await userEvent.click(screen.getByRole('button', { name: 'Follow the end' }));
    expect(scroller.scrollTop).toBe(900);
    expect(screen.queryByRole('button', { name: 'Follow the end' })).toBeNull();
  });
});
