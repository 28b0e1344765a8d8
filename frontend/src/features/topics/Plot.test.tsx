import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { resetTopics, useTopicsStore } from '@/store/session/topics';
import { show, user } from '../../../harness/testing';
import { Plot } from './Plot';

const plotted = () => useTopicsStore.getState().plotted.map(({ topic, path }) => `${topic}.${path}`);

beforeEach(() => {
  useTopicsStore.setState({
    plotted: [
      { topic: '/odom', path: 'x' },
      { topic: '/odom', path: 'y' },
    ],
  });
  onTestFinished(() => {
    act(resetTopics);
  });
});

describe('Plot', () => {
  it('names each line by its colour, and takes it out', async () => {
    show(<Plot isVisible={false} />);
    const lines = screen.getAllByRole('button', { name: /^Remove \/odom/ });
    expect(lines.map(({ textContent }) => textContent)).toEqual(['/odom.x', '/odom.y']);
    const colors = lines.map((line) => line.querySelector('span')?.style.background);
    expect(colors[0]).not.toBe(colors[1]);
    await user.click(screen.getByRole('button', { name: 'Remove /odom.x from the plot' }));
    expect(plotted()).toEqual(['/odom.y']);
  });

  it('pauses and continues', async () => {
    show(<Plot isVisible={false} />);
    await user.click(screen.getByRole('button', { name: 'Pause the plot' }));
    await user.click(screen.getByRole('button', { name: 'Resume' }));
    expect(screen.getByRole('button', { name: 'Pause the plot' })).toBeInTheDocument();
  });

  it('is closed with all its lines', async () => {
    show(<Plot isVisible={false} />);
    await user.click(screen.getByRole('button', { name: 'Close the plot' }));
    expect(plotted()).toEqual([]);
  });

  it('draws nothing while it is hidden', () => {
    show(<Plot isVisible={false} />);
    expect(document.querySelector('.uplot')).toBeNull();
  });
});
