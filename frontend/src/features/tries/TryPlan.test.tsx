import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { outcomeOf } from '../../../harness/tries';
import { TryPlan } from './TryPlan';

it('says where no robot moved', () => {
  show(<TryPlan outlines={[]} outcomes={[outcomeOf(0, { paths: {} })]} />);
  expect(screen.getByText('No continuation moved a robot.')).toBeVisible();
});
