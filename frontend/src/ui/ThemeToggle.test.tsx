import { fireEvent, screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { useViewMode } from '@/store/viewMode';
import { basicPage } from '../../harness/basicPage';
import { show, user } from '../../harness/testing';
import { ThemeToggle } from './ThemeToggle';

it('keeps no tip open over the page in its new theme', async () => {
  show(<ThemeToggle />);
  const toggle = screen.getByTestId('theme-toggle');
  await user.hover(toggle);
  expect(await screen.findByRole('tooltip')).toHaveTextContent('Dark theme');
  fireEvent.pointerDown(toggle);
  expect(screen.queryByRole('tooltip')).toBeNull();
});

it('is in the menu of a project in the basic page, and a button elsewhere', () => {
  basicPage();
  const { unmount } = show(<ThemeToggle />);
  expect(screen.queryByTestId('theme-toggle')).toBeNull();
  unmount();
  useViewMode.setState({ isInProject: false });
  show(<ThemeToggle />);
  expect(screen.getByTestId('theme-toggle')).toBeInTheDocument();
});
