import { screen } from '@testing-library/react';
import { expect, it, onTestFinished, vi } from 'vitest';
import { setLanguage } from '@/i18n';
import { show, user } from '../../../harness/testing';
import { OrderDialog } from './OrderDialog';
import type { OrderOffer } from './useImport';

const offer: OrderOffer = {
  asked: { file: new File([], 'robot.zip'), repair: false, order: 'ask' },
  finding: {
    code: 'BT0811',
    severity: 'warning',
    message: '“turn” is never ticked.',
    values: { order: 'top-to-bottom', other: 'bottom-to-top' },
  },
};

it('proposes the order that reaches all branches, and takes the own one on demand', async () => {
  const onChoose = vi.fn();
  const onClose = vi.fn();
  show(<OrderDialog offer={offer} onChoose={onChoose} onClose={onClose} />);
  expect(screen.getByText('“turn” is never ticked.')).toBeInTheDocument();
  expect(screen.getByText(/robot\.zip/)).toBeInTheDocument();
  expect(screen.getByRole('radio', { name: /^From the bottom/ })).toBeChecked();
  await user.click(screen.getByRole('button', { name: 'Import' }));
  await user.click(screen.getByRole('radio', { name: /^From the top/ }));
  await user.click(screen.getByRole('button', { name: 'Import' }));
  expect(onChoose.mock.calls).toEqual([['bottom-to-top'], ['top-to-bottom']]);
  await user.click(screen.getByRole('button', { name: 'Do not import' }));
  expect(onClose).toHaveBeenCalledTimes(1);
});

it('says the orders in the language of the page', async () => {
  setLanguage('es');
  onTestFinished(() => setLanguage('en'));
  show(<OrderDialog offer={offer} onChoose={vi.fn()} onClose={vi.fn()} />);
  expect(await screen.findByText(/hijos del proyecto, de arriba abajo en el lienzo, «/)).toHaveTextContent(
    'En el orden de abajo arriba en el lienzo se llega a todas las ramas.',
  );
});
